#include "processes/serve/frame_assembly.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <utility>

#include "processes/conversions.hpp"
#include "redbee/bus/image.hpp"
#include "redbee/fusion/fused_homography.hpp"

namespace redbee {
namespace {

constexpr size_t kMostImages = 128;  ///< a second and more
constexpr size_t kMostImageBytes = size_t{64} << 20;
constexpr int64_t kWithoutDetections_us = 1'000'000;  ///< longer than any frame's way through the processes

size_t bytesOf(const std::deque<std::shared_ptr<const image_t>>& images) {
  size_t bytes = 0;
  for (const auto& image : images) bytes += image->data.size();
  return bytes;
}

}  // namespace

FrameAssembly::FrameAssembly(const Configuration& configuration)
    : width_(configuration.camera.width),
      height_(configuration.camera.height),
      trails_(Camera(configuration.camera)) {}

void FrameAssembly::onFused(const fused_homography_t& fused) {
  source_ = toString(static_cast<FusionSource>(fused.source));
  if (fused.source != fused_homography_t::NONE)
    trails_.addStep(fused.utime_previous, fused.utime, matrix3(fused.step.H));
}

void FrameAssembly::onImage(image_t image) {
  auto shared = std::make_shared<const image_t>(std::move(image));
  // A clock that was set back: what was kept is of another time.
  if (!images_.empty() && shared->utime < images_.back()->utime - kWithoutDetections_us) dropImages();
  images_.push_back(shared);
  while (images_.size() > kMostImages || bytesOf(images_) > kMostImageBytes) images_.pop_front();
  const int64_t behind = shared->utime - detections_utime_;
  if (behind > kWithoutDetections_us || behind < -kWithoutDetections_us) showWithoutDetections(shared);
}

void FrameAssembly::showWithoutDetections(const std::shared_ptr<const image_t>& image) {
  FrameView view;
  view.utime = image->utime;
  view.image = image;
  const double behind = static_cast<double>(image->utime - detections_utime_) / 1e6;
  view.note = detections_utime_ == 0 || behind < 0
                  ? "no DETECTIONS: redbee-motion-segmentation does not answer"
                  : fmt::format("no DETECTIONS for {:.1f} s", behind);
  if (const std::string fault = cameraFault(*image); !fault.empty()) view.note = fault;
  ready_ = std::move(view);
}

/// Empty: nothing shows that the image is of another camera than the vehicle file's.
std::string FrameAssembly::cameraFault(const image_t& image) const {
  const cv::Size size = declaredSize(image);
  if (size == cv::Size(width_, height_)) return "";
  return fmt::format("another camera: its images are {}x{}, those of the vehicle file {}x{}", size.width,
                     size.height, width_, height_);
}

void FrameAssembly::onForeground(foreground_t foreground) {
  masks_.push_back(std::move(foreground));
  if (masks_.size() > kMostImages) masks_.pop_front();
}

void FrameAssembly::onDetections(detections_t detections) {
  detections_utime_ = detections.utime;
  trails_.addDetections(detections);
  const auto isOfFrame = [&](const auto& image) { return image->utime == detections.utime; };
  const auto image = std::find_if(images_.begin(), images_.end(), isOfFrame);
  if (image == images_.end()) return;
  FrameView view;
  view.utime = detections.utime;
  view.image = *image;
  view.note = cameraFault(**image);
  view.trails = trails_.trails();
  view.source = source_;
  const auto mask = std::find_if(masks_.begin(), masks_.end(),
                                 [&](const foreground_t& m) { return m.utime == detections.utime; });
  if (mask != masks_.end() && mask->status == foreground_t::GOOD) view.mask = std::move(mask->mask);
  view.detections = std::move(detections);
  images_.erase(images_.begin(), image);
  while (!masks_.empty() && masks_.front().utime <= view.utime) masks_.pop_front();
  ready_ = std::move(view);
}

void FrameAssembly::dropImages() {
  images_.clear();
  masks_.clear();
  ready_.reset();
}

std::optional<FrameView> FrameAssembly::takeFrame() { return std::exchange(ready_, std::nullopt); }

}  // namespace redbee
