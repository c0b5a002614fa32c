#include "processes/foreground_publisher.hpp"

#include <utility>

#include "processes/detection_messages.hpp"
#include "redbee/bus/image.hpp"
#include "redbee/detections_t.hpp"
#include "redbee/foreground_t.hpp"
#include "redbee/image_codec/png.hpp"
#include "redbee/node/frame_time.hpp"
#include "redbee/node/message_limits.hpp"
#include "redbee/results/overlay.hpp"

namespace redbee {
namespace {

constexpr int kOverlayQuality = 80;
/// Value in the unknown mask.
constexpr uchar kUnknown = 255;

detections_t detectionsMessage(const DetectorOutput& output) {
  detections_t message{};
  message.status = static_cast<int8_t>(output.status);
  message.n = static_cast<int32_t>(output.detections.size());
  for (const Detection& detection : output.detections) {
    message.detections.push_back(messageOf(detection));
  }
  return message;
}

/// Box on the raw grid around a box on the ideal grid; empty if the raw image does not show it.
cv::Rect rawBox(const Camera& camera, const cv::Rect& box, const std::optional<RowMotion>& rows) {
  const cv::Rect image(0, 0, camera.intrinsics().width, camera.intrinsics().height);
  Eigen::Vector2d low(image.width, image.height);
  Eigen::Vector2d high(0, 0);
  for (int i = 0; i <= 4; ++i) {
    for (const Eigen::Vector2d& edge : {Eigen::Vector2d(i / 4.0, 0), Eigen::Vector2d(i / 4.0, 1),
                                        Eigen::Vector2d(0, i / 4.0), Eigen::Vector2d(1, i / 4.0)}) {
      const Eigen::Vector2d ideal(box.x + edge.x() * (box.width - 1), box.y + edge.y() * (box.height - 1));
      const auto raw = rows ? rawPixel(camera, ideal, *rows) : camera.distort(ideal);
      if (!raw) continue;
      low = low.cwiseMin(*raw);
      high = high.cwiseMax(*raw);
    }
  }
  if (low.x() > high.x()) return {};
  const cv::Point top_left(static_cast<int>(std::floor(low.x())), static_cast<int>(std::floor(low.y())));
  const cv::Point bottom_right(static_cast<int>(std::ceil(high.x())) + 1,
                               static_cast<int>(std::ceil(high.y())) + 1);
  return cv::Rect(top_left, bottom_right) & image;
}

}  // namespace

void ForegroundPublisher::publish(const image_t& image, CameraTime time_previous, DetectorOutput output,
                                  const Exposure& exposure) {
  // With more, all receivers would refuse the message.
  output.detections = strongest(std::move(output.detections), message_limits::kMaxDetections);
  const Rectifier& rectifier = camera_.rectifier();
  // Of any detector: most know nothing of the vehicle's own parts.
  if (const cv::Mat1b& own_parts = rectifier.ownParts(exposure); !own_parts.empty()) {
    for (const auto& [map, value] : {std::pair(&output.probability, 0), std::pair(&output.mask, 0),
                                     std::pair(&output.unknown, static_cast<int>(kUnknown))}) {
      *map = map->clone();
      map->setTo(value, own_parts);
    }
  }
  output.probability = rectifier.toRaw(output.probability, 0, exposure);
  output.mask = rectifier.toRaw(output.mask, 0, exposure);
  output.unknown = rectifier.toRaw(output.unknown, kUnknown, exposure);
  if (camera_.camera().isDistorted() || exposure.rows) {
    const Camera lens = zoomed(camera_.camera(), exposure.zoom);
    for (Detection& detection : output.detections) {
      detection.box = rawBox(lens, detection.box, exposure.rows);
    }
  }
  foreground_t foreground{};
  foreground.utime_previous = toUtime(time_previous);
  foreground.status = static_cast<int8_t>(output.status);
  foreground.width = output.mask.cols;
  foreground.height = output.mask.rows;
  foreground.probability = encodePng(output.probability);
  foreground.mask = encodePng(output.mask);
  foreground.unknown = encodeBilevelPng(output.unknown);
  foreground.probability_size = static_cast<int32_t>(foreground.probability.size());
  foreground.mask_size = static_cast<int32_t>(foreground.mask.size());
  foreground.unknown_size = static_cast<int32_t>(foreground.unknown.size());
  publisher_.publish(configuration_.channels.foreground, foreground);

  publisher_.publish(configuration_.channels.detections, detectionsMessage(output));
  publishOverlay(image, output);
}

void ForegroundPublisher::publishOverlay(const image_t& image, const DetectorOutput& output) {
  const int period = configuration_.overlay_period_frames;
  if (!draws_overlays_ || period == 0 || ++frames_since_overlay_ < period) return;
  frames_since_overlay_ = 0;
  if (const auto colour = decodeColour(image); colour && colour->size() == output.mask.size()) {
    OverlayStatus status;
    status.time = timeOf(image);
    status.message = output.status == DetectorStatus::kGood ? "" : toString(output.status);
    const cv::Mat drawn = drawOverlay(*colour, output.mask, output.detections, status);
    publisher_.publish(configuration_.channels.overlay, jpegMessage(image.utime, drawn, kOverlayQuality));
  }
}

}  // namespace redbee
