// Rows of an image that is doubled by linear interpolation, as vector code.
#pragma once

#include <cstdint>

namespace redbee {

/// Four times the values between the pixels of a row: 2 `width` of them.
void doubleAcross(const uint8_t* row, int width, uint16_t* to);
/// Three quarters of one such row and a quarter of the other, rounded as cv::resize() does.
void mixRows(const uint16_t* near, const uint16_t* far, int width, uint8_t* to);

}  // namespace redbee
