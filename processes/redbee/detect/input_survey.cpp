#include "processes/redbee/detect/input_survey.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "redbee/bus/image.hpp"
#include "redbee/bus/message_name.hpp"
#include "redbee/lens_t.hpp"
#include "redbee/node/message_check.hpp"

namespace redbee {

void InputSurvey::Span::add(int64_t utime) {
  first_utime = count == 0 ? utime : std::min(first_utime, utime);
  last_utime = count == 0 ? utime : std::max(last_utime, utime);
  ++count;
}

void InputSurvey::add(const LogEvent& event) {
  if (event.channel == configuration_.channels.camera) {
    image_t image;
    const bool is_image = decodePlausible(event.data, image);
    camera_.add(is_image ? image.utime : event.utime);
    if (camera_.count == 1) first_image_ = event.data;
  } else if (event.channel == configuration_.channels.imu) {
    ins_t sample;
    imu_.add(decodePlausible(event.data, sample) ? sample.utime : event.utime);
  } else if (event.channel == configuration_.channels.lens) {
    ++lens_messages_;
    lens_t lens;
    if (!decodePlausible(event.data, lens) || lens.has_focal_length == 0) return;
    const double focal_px = lens.focal_length / lens.width * configuration_.camera.width;
    if (longest_focal_px_ == 0) shortest_focal_px_ = focal_px;
    shortest_focal_px_ = std::min(shortest_focal_px_, focal_px);
    longest_focal_px_ = std::max(longest_focal_px_, focal_px);
  }
}

std::vector<std::string> InputSurvey::warnings() const {
  const std::string& channel = configuration_.channels.imu;
  std::vector<std::string> lines;
  if (configuration_.has_imu && imu_.count == 0) {
    lines.push_back("imu.present is true, but the log holds no message on " + channel +
                    ": set imu.present: false");
  } else if (!configuration_.has_imu && imu_.count > 0) {
    lines.push_back("imu.present is false: the " + std::to_string(imu_.count) + " messages on " + channel +
                    " are not used");
  } else if (imu_.count > 0 &&
             (imu_.first_utime > camera_.last_utime || imu_.last_utime < camera_.first_utime)) {
    lines.push_back("the messages on " + channel + " cover none of the images: their times are " +
                    std::to_string(imu_.first_utime) + " to " + std::to_string(imu_.last_utime) +
                    " us, the images' " + std::to_string(camera_.first_utime) + " to " +
                    std::to_string(camera_.last_utime) + " us: check their clocks");
  }
  if (const std::string lens = lensWarning(); !lens.empty()) lines.push_back(lens);
  return lines;
}

std::string InputSurvey::lensWarning() const {
  constexpr double kZooms = 1.02;  // an error of the focal length that distorts every homography
  const std::string& channel = configuration_.channels.lens;
  if (configuration_.inertial.lens.enabled) {
    if (lens_messages_ > 0) return "";
    return "lens.enabled is true, but the log holds no message on " + channel +
           ": the configured focal length holds for all images";
  }
  if (longest_focal_px_ <= kZooms * shortest_focal_px_) return "";
  return fmt::format(
      "{} says focal lengths from {:.0f} to {:.0f} px, but lens.enabled is false: a zoom looks like a climb",
      channel, shortest_focal_px_, longest_focal_px_);
}

std::string InputSurvey::faultOfFirstImage() const {
  const std::string& channel = configuration_.channels.camera;
  const std::string name = messageName(first_image_);
  if (name.empty())
    return channel + " holds messages of an unknown type, " + messageHash(first_image_) + ", not image_t";
  if (name != image_t::getTypeName()) return channel + " holds " + name + ", not image_t";
  image_t image;
  if (!decodeMessage(first_image_.data(), static_cast<int>(first_image_.size()), image))
    return channel + ": the message is damaged";
  if (!isPlausible(image)) return channel + ": implausible " + faultOf(image);
  return faultOfImage(image);
}

}  // namespace redbee
