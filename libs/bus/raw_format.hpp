// Uncompressed pixel formats of image_t.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "redbee/image_t.hpp"

namespace redbee {

/// Grey or BGR, 8 bits; std::nullopt if the format is compressed or not known, or the sizes do not agree.
/// Formats and their numbers are bot_core's: grey, RGB, BGR, with alpha, YUYV, UYVY, I420, NV12, Bayer, and
/// grey of 16 bits. The latter are scaled by their own range, but for 0.1 % of the pixels at each end.
std::optional<cv::Mat> decodeRaw(const image_t& message, bool colour);

bool isRawFormat(int32_t pixelformat);
/// The names of all formats that are read, JPEG included.
std::string readableFormats();
/// The name, or the four letters, or the number.
std::string formatName(int32_t pixelformat);
/// The number of an uncompressed format by its name; 0 for others.
int32_t formatNamed(const std::string& name);

}  // namespace redbee
