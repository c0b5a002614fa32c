// PNG in memory, by libspng.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

namespace redbee {

/// The image as it is stored: grey or BGR, of 8 or 16 bits (CV_8UC1 to CV_16UC3); fewer bits and palettes are
/// widened, transparency is left out. Empty if it is damaged, cut short, or no PNG.
cv::Mat decodePng(const std::vector<uint8_t>& bytes);

/// `image`: grey, BGR or BGRA of 8 bits, not empty. Compressed for speed: maps with few distinct values take
/// a few hundred bytes.
std::vector<uint8_t> encodePng(const cv::Mat& image);
/// With one bit per pixel, for a map of 0 and 255.
std::vector<uint8_t> encodeBilevelPng(const cv::Mat1b& map);

}  // namespace redbee
