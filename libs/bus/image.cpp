#include "redbee/bus/image.hpp"

#include <algorithm>
#include <array>
#include <opencv2/imgproc.hpp>

#include "redbee/bus/raw_format.hpp"
#include "redbee/image_codec/jpeg.hpp"

namespace redbee {
namespace {

constexpr int kMaxSide = 16384;

bool plausibleSize(const image_t& message) {
  return message.width > 0 && message.height > 0 && message.width <= kMaxSide && message.height <= kMaxSide &&
         message.size >= 0 && static_cast<size_t>(message.size) == message.data.size();
}

bool canShrink(const image_t& message, int downscale) {
  return (downscale == 1 || downscale == 2 || downscale == 4) && message.width % downscale == 0 &&
         message.height % downscale == 0;
}

int big16(const uint8_t* data) { return data[0] << 8 | data[1]; }

/// Offset of the marker that begins the frame header.
std::optional<size_t> jpegFrameHeader(const uint8_t* data, size_t size) {
  if (size < 4 || data[0] != 0xFF || data[1] != 0xD8) return std::nullopt;
  size_t at = 2;
  while (at + 9 <= size && data[at] == 0xFF) {
    const uint8_t marker = data[at + 1];
    const bool is_frame_header =
        marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
    if (is_frame_header) return at;
    at += marker == 0xFF ? 1 : 2 + static_cast<size_t>(big16(data + at + 2));
  }
  return std::nullopt;
}

/// libjpeg silently fills the rest of a truncated image with grey. Cameras may pad behind the end marker, and
/// a thumbnail has one of its own, before the frame header.
bool isWholeJpeg(const std::vector<uint8_t>& data) {
  const std::array<uint8_t, 2> end_of_image = {0xFF, 0xD9};
  const auto header = jpegFrameHeader(data.data(), data.size());
  if (!header) return false;
  const auto first = data.begin() + static_cast<std::ptrdiff_t>(*header);
  return std::find_end(first, data.end(), end_of_image.begin(), end_of_image.end()) != data.end();
}

std::optional<cv::Mat> decodeWholeJpeg(const image_t& message, bool colour, int downscale) {
  const auto declared = jpegSize(message.data.data(), message.data.size());
  if (!declared || *declared != cv::Size(message.width, message.height)) return std::nullopt;
  if (!isWholeJpeg(message.data)) return std::nullopt;
  // The camera's matrix and mounting are those of the sensor, whatever orientation the JPEG states.
  cv::Mat decoded = decodeJpeg(message.data, colour, downscale);
  if (decoded.size() != *declared / downscale) return std::nullopt;
  return decoded;
}

std::optional<cv::Mat> decode(const image_t& message, bool colour, int downscale) {
  if (!plausibleSize(message) || !canShrink(message, downscale)) return std::nullopt;
  if (message.pixelformat == image_t::MJPEG) return decodeWholeJpeg(message, colour, downscale);
  auto image = decodeRaw(message, colour);
  if (image && downscale > 1) cv::resize(*image, *image, image->size() / downscale, 0, 0, cv::INTER_AREA);
  return image;
}

}  // namespace

std::optional<cv::Size> jpegSize(const uint8_t* data, size_t size) {
  const auto header = jpegFrameHeader(data, size);
  if (!header) return std::nullopt;
  return cv::Size(big16(data + *header + 7), big16(data + *header + 5));
}

cv::Size declaredSize(const image_t& message) {
  const cv::Size declared(message.width, message.height);
  if (message.pixelformat != image_t::MJPEG) return declared;
  return jpegSize(message.data.data(), message.data.size()).value_or(declared);
}

std::optional<cv::Mat1b> decodeGrey(const image_t& message) { return decodeGrey(message, 1); }
std::optional<cv::Mat3b> decodeColour(const image_t& message) { return decodeColour(message, 1); }

std::optional<cv::Mat1b> decodeGrey(const image_t& message, int downscale) {
  return decode(message, false, downscale);
}

std::optional<cv::Mat3b> decodeColour(const image_t& message, int downscale) {
  return decode(message, true, downscale);
}

std::string faultOfImage(const image_t& message) {
  if (decode(message, false, 1)) return "";
  const std::string name = formatName(message.pixelformat);
  if (message.pixelformat != image_t::MJPEG && !isRawFormat(message.pixelformat))
    return "pixel format " + name + " is not read; those that are: " + readableFormats();
  return std::to_string(message.data.size()) + " bytes are no " + name + " image of " +
         std::to_string(message.width) + "x" + std::to_string(message.height) + ", row stride " +
         std::to_string(message.row_stride);
}

image_t rawGreyMessage(int64_t utime, const cv::Mat1b& grey) {
  image_t message;
  message.utime = utime;
  message.width = grey.cols;
  message.height = grey.rows;
  message.row_stride = grey.cols;
  message.pixelformat = image_t::GRAY;
  const cv::Mat1b whole = grey.isContinuous() ? grey : grey.clone();
  message.data.assign(whole.data, whole.data + whole.total());
  message.size = static_cast<int32_t>(message.data.size());
  message.nmetadata = 0;
  return message;
}

image_t jpegMessage(int64_t utime, const cv::Mat& image, int quality) {
  image_t message;
  message.utime = utime;
  message.width = image.cols;
  message.height = image.rows;
  message.row_stride = 0;
  message.pixelformat = image_t::MJPEG;
  message.data = encodeJpeg(image, quality);
  message.size = static_cast<int32_t>(message.data.size());
  message.nmetadata = 0;
  return message;
}

}  // namespace redbee
