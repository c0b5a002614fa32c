#include "processes/camera/node.hpp"

#include <spdlog/spdlog.h>

#include <chrono>
#include <thread>
#include <utility>

#include "processes/camera/exposure_middle.hpp"
#include "redbee/bus/image.hpp"
#include "redbee/configuration/process_table.hpp"
#include "redbee/node/message_check.hpp"
#include "redbee/node/work_timer.hpp"

namespace redbee {
namespace {

constexpr std::chrono::milliseconds kImageWait{20};
// Drivers and cameras hang without an error. Longer than rtspsrc takes to try UDP (5 s), then TCP.
constexpr int64_t kLongestSilence_ns = 15'000'000'000;

}  // namespace

CameraNode::CameraNode(Bus& bus, const Configuration& configuration, std::unique_ptr<FrameSource> source,
                       Clock clock)
    : bus_(bus),
      configuration_(configuration),
      health_(programName(kCamera), configurationHash(configuration)),
      source_(std::move(source)),
      clock_(std::move(clock)),
      watch_(configuration.capture.rate_hz) {
  health_.explainsSilence();
}

void CameraNode::postpone(const std::string& fault) {
  if (fault != source_fault_) spdlog::warn("{}", fault);
  source_fault_ = fault;
  back_off_.postpone(clock_());
  health_.setState(HealthState::kDegraded, fault);
}

bool CameraNode::openSource() {
  if (source_->isOpen()) return true;
  if (!back_off_.isDue(clock_())) {
    std::this_thread::sleep_for(kImageWait);
    return false;
  }
  if (const std::string fault = source_->open(); !fault.empty()) {
    postpone(fault);
    return false;
  }
  watch_ = ImageWatch(configuration_.capture.rate_hz);
  silent_since_ns_ = clock_();
  return true;
}

bool CameraNode::processNext() {
  if (!openSource()) return true;
  auto image = source_->next(kImageWait);
  if (image) {
    silent_since_ns_ = clock_();
    image->utime += toExposureMiddle(configuration_.capture, configuration_.camera, exposureTime()).count();
    publish(*image);
  }
  if (!source_->isOpen()) {
    postpone(source_->fault());
  } else if (clock_() - silent_since_ns_ > kLongestSilence_ns) {
    source_->close();
    postpone("the source gives no images: it is opened again");
  }
  return true;
}

double CameraNode::exposureTime() const {
  return source_->exposure_s().value_or(configuration_.capture.exposure_s);
}

bool CameraNode::isUsable(const image_t& image) {
  const CameraIntrinsics& camera = configuration_.camera;
  const cv::Size size = declaredSize(image);
  if (size != cv::Size(camera.width, camera.height)) {
    health_.noteDamaged();
    health_.setState(HealthState::kDegraded, "the pipeline gives images of " + std::to_string(size.width) +
                                                 "x" + std::to_string(size.height) + ", configured are " +
                                                 std::to_string(camera.width) + "x" +
                                                 std::to_string(camera.height));
    return false;
  }
  if (!isPlausible(image)) {
    health_.noteDamaged();
    return false;
  }
  // Of two images with one time nobody could say which was first.
  if (last_us_ && image.utime <= *last_us_) {
    health_.noteSkipped();
    return false;
  }
  return true;
}

void CameraNode::publish(image_t image) {
  const FrameTimers timers;
  if (!isUsable(image)) return;
  source_fault_.clear();
  back_off_.reset();
  last_us_ = image.utime;
  health_.noteInput(fromUtime(image.utime));
  watch_.note(image);
  if (configuration_.capture.jpeg_quality > 0 && image.pixelformat != image_t::MJPEG) {
    const bool is_grey = image.pixelformat == image_t::GRAY;
    const cv::Mat pixels = is_grey ? cv::Mat(decodeGrey(image).value_or(cv::Mat1b()))
                                   : cv::Mat(decodeColour(image).value_or(cv::Mat3b()));
    if (pixels.empty()) return health_.noteDamaged();
    image = jpegMessage(image.utime, pixels, configuration_.capture.jpeg_quality);
  }
  bus_.publish(configuration_.channels.camera, image);
  noteDone(health_, CameraTime(fromUtime(image.utime)), timers.wall, timers);
  std::string fault = watch_.fault();
  if (fault.empty()) fault = source_->timeFault();
  if (fault.empty() && configuration_.capture.stamp != "middle" && exposureTime() == 0) {
    fault =
        "the driver does not tell the exposure time, and capture.exposure_s is not set: the images' times "
        "are not "
        "those of their middle";
  }
  health_.setState(fault.empty() ? HealthState::kGood : HealthState::kDegraded, fault);
}

}  // namespace redbee
