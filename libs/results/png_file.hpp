// PNG files: maps, masks and stills.
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>

namespace redbee {

/// Any image that OpenCV writes as PNG. Throws InputError if it cannot be written.
void writePng(const std::filesystem::path& file, const cv::Mat& image);
/// 8-bit grey. Throws InputError if the file is missing or is not an image.
cv::Mat1b readGreyPng(const std::filesystem::path& file);

}  // namespace redbee
