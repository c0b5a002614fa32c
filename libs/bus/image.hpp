// Images inside image_t messages.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "redbee/image_t.hpp"

namespace redbee {

/// Width and height that a JPEG's header declares; nothing where there is no such header. Decodes nothing.
std::optional<cv::Size> jpegSize(const uint8_t* data, size_t size);

/// The image as 8-bit grey, or as BGR. Nothing where the message's size or format is wrong, or it is
/// truncated: sizes are compared with the header's before anything is decoded.
std::optional<cv::Mat> decodeGrey(const image_t& message);
std::optional<cv::Mat> decodeColour(const image_t& message);
/// The same at a size 1, 2 or 4 times smaller, which must divide the image's. A JPEG is not decoded to its
/// full size first: at half size it costs half.
std::optional<cv::Mat> decodeGrey(const image_t& message, int downscale);
std::optional<cv::Mat> decodeColour(const image_t& message, int downscale);

image_t rawGreyMessage(int64_t utime, const cv::Mat& grey);
/// `image`: grey or BGR.
image_t jpegMessage(int64_t utime, const cv::Mat& image, int quality);

/// 8-bit single-channel PNG, made for speed: maps with few values shrink to a few hundred bytes.
std::vector<uint8_t> encodePng(const cv::Mat& map);
/// PNG of one bit a pixel, for a map of 0 and 255.
std::vector<uint8_t> encodeBilevelPng(const cv::Mat& map);

}  // namespace redbee
