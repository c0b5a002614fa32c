#include "redbee/results/overlay.hpp"

#include <spdlog/fmt/fmt.h>

#include <array>
#include <opencv2/imgproc.hpp>

namespace redbee {
namespace {

const cv::Scalar kMaskColour(60, 60, 255);
const cv::Scalar kMissedColour(170, 170, 170);

/// Consecutive identities get clearly different colours.
cv::Scalar identityColour(int id) {
  static const std::array<cv::Scalar, 8> kColours = {cv::Scalar(0, 230, 255),   cv::Scalar(255, 190, 0),
                                                     cv::Scalar(90, 255, 90),   cv::Scalar(255, 90, 255),
                                                     cv::Scalar(0, 150, 255),   cv::Scalar(255, 255, 90),
                                                     cv::Scalar(180, 120, 255), cv::Scalar(120, 220, 180)};
  return kColours[static_cast<size_t>(id < 0 ? -id : id) % kColours.size()];
}

/// A dark outline keeps the text readable on any background.
void putLabel(cv::Mat& canvas, const std::string& text, cv::Point at, const cv::Scalar& colour) {
  constexpr double kScale = 0.45;
  cv::putText(canvas, text, at, cv::FONT_HERSHEY_SIMPLEX, kScale, cv::Scalar::all(0), 3, cv::LINE_AA);
  cv::putText(canvas, text, at, cv::FONT_HERSHEY_SIMPLEX, kScale, colour, 1, cv::LINE_AA);
}

cv::Vec3b tinted(const cv::Vec3b& pixel) {
  cv::Vec3b mixed;
  for (int i = 0; i < 3; ++i) mixed[i] = cv::saturate_cast<uint8_t>(0.6 * pixel[i] + 0.4 * kMaskColour[i]);
  return mixed;
}

void drawMask(cv::Mat3b& canvas, const cv::Mat1b& mask) {
  if (mask.empty() || mask.size() != canvas.size()) return;
  // Faster than OpenCV's addWeighted() on the whole image, as a mask covers little of it.
  for (int y = 0; y < canvas.rows; ++y) {
    const uint8_t* marked = mask[y];
    cv::Vec3b* pixels = canvas[y];
    for (int x = 0; x < canvas.cols; ++x) {
      if (marked[x] != 0) pixels[x] = tinted(pixels[x]);
    }
  }
  std::vector<std::vector<cv::Point>> outlines;
  cv::findContours(mask, outlines, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  cv::drawContours(canvas, outlines, -1, kMaskColour, 1);
}

void drawDetection(cv::Mat& canvas, const Detection& detection) {
  const cv::Scalar colour = detection.seen ? identityColour(detection.id) : kMissedColour;
  cv::rectangle(canvas, detection.box, colour, detection.seen ? 2 : 1);
  const bool room_above = detection.box.y > 30;
  const cv::Point at(std::max(0, detection.box.x),
                     room_above ? detection.box.y - 4 : detection.box.y + detection.box.height + 13);
  putLabel(canvas, std::to_string(detection.id), at, colour);
}

std::string statusLine(const OverlayStatus& status) {
  std::string line = fmt::format("{:.3f} s", static_cast<double>(toUtime(status.time)) / 1e6);
  if (status.fps > 0) line += fmt::format("  {:.1f} fps", status.fps);
  if (!status.source.empty()) line += fmt::format("  {}  epoch {}", status.source, status.epoch);
  return line + (status.message.empty() ? "" : "  " + status.message);
}

}  // namespace

cv::Mat3b drawOverlay(cv::Mat image, const cv::Mat1b& mask, const std::vector<Detection>& detections,
                      const OverlayStatus& status) {
  if (image.channels() == 1) cv::cvtColor(image, image, cv::COLOR_GRAY2BGR);
  cv::Mat3b canvas = std::move(image);
  drawMask(canvas, mask);
  for (const Detection& detection : detections) drawDetection(canvas, detection);
  putLabel(canvas, statusLine(status), {8, 18}, cv::Scalar::all(255));
  return canvas;
}

}  // namespace redbee
