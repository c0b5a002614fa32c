// Images inside image_t messages.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "redbee/image_t.hpp"

namespace redbee {

/// Width and height that a JPEG's header declares; std::nullopt if there is no such header. Decodes nothing.
std::optional<cv::Size> jpegSize(const uint8_t* data, size_t size);

/// Width and height of the image, by the message or, where they differ, by the header of its JPEG, which is
/// what decoding would allocate. Decodes nothing.
cv::Size declaredSize(const image_t& message);

/// The image in grey, or in BGR. std::nullopt if the message's size or format is wrong or the data is
/// truncated; sizes are compared with the header's before anything is decoded. Formats: see decodeRaw(); an
/// orientation that a JPEG states is not applied.
std::optional<cv::Mat1b> decodeGrey(const image_t& message);
std::optional<cv::Mat3b> decodeColour(const image_t& message);
/// The same, downscaled by 1, 2 or 4, which must divide the image's width and height. A JPEG is decoded at
/// the smaller size directly, which at half size takes half the time.
std::optional<cv::Mat1b> decodeGrey(const image_t& message, int downscale);
std::optional<cv::Mat3b> decodeColour(const image_t& message, int downscale);

/// Why decodeGrey() refuses the image, in one line: the pixel format, or the sizes. Empty if it does not.
std::string faultOfImage(const image_t& message);

image_t rawGreyMessage(int64_t utime, const cv::Mat1b& grey);
/// `image`: grey or BGR.
image_t jpegMessage(int64_t utime, const cv::Mat& image, int quality);

}  // namespace redbee
