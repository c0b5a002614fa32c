// JPEG in memory, by libjpeg-turbo.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

namespace redbee {

/// The image in grey (CV_8UC1) or BGR (CV_8UC3), at 1, 1/2, 1/4 or 1/8 of its size, which costs in
/// proportion; sizes are rounded up. An orientation that it states is not applied. Empty if it cannot be
/// decoded; what damage leaves of an image is shown, and what is missing filled with grey.
cv::Mat decodeJpeg(const std::vector<uint8_t>& bytes, bool colour, int downscale = 1);

/// Whether it has no colours, by its header.
bool isGreyJpeg(const std::vector<uint8_t>& bytes);

/// Orientation that its EXIF data states, 1 to 8; 1, which is upright, if there is none.
int jpegOrientation(const std::vector<uint8_t>& bytes);
/// Focal lengths that its EXIF data states, each where it does.
struct ExifLens {
  std::optional<double> focal_mm;       ///< of the lens
  std::optional<double> equivalent_mm;  ///< of a camera on film of 36 mm width with the same view
  double digital_zoom = 1;              ///< how much is cropped of what the lens shows
};
ExifLens jpegLens(const std::vector<uint8_t>& bytes);
/// The image turned and mirrored as an orientation of EXIF says.
cv::Mat upright(const cv::Mat& image, int orientation);

/// `image`: grey or BGR, not empty; quality 1 to 100, colour at half of the resolution.
std::vector<uint8_t> encodeJpeg(const cv::Mat& image, int quality);

}  // namespace redbee
