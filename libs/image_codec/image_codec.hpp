// JPEG or PNG in memory, whichever it is.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

namespace redbee {

bool isJpeg(const std::vector<uint8_t>& bytes);
bool isPng(const std::vector<uint8_t>& bytes);

/// As decodePng() or decodeJpeg() in colour; a JPEG in grey gives CV_8UC1. Empty if it is neither or damaged.
cv::Mat decodeImage(const std::vector<uint8_t>& bytes);
/// The same in grey of 8 bits: of 16 bits the upper ones.
cv::Mat1b decodeGreyImage(const std::vector<uint8_t>& bytes);

}  // namespace redbee
