#include "redbee/bus/image.hpp"

#include <algorithm>
#include <array>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

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

int jpegFlags(bool colour, int downscale) {
  switch (downscale) {
    case 2:
      return colour ? cv::IMREAD_REDUCED_COLOR_2 : cv::IMREAD_REDUCED_GRAYSCALE_2;
    case 4:
      return colour ? cv::IMREAD_REDUCED_COLOR_4 : cv::IMREAD_REDUCED_GRAYSCALE_4;
    default:
      return colour ? cv::IMREAD_COLOR : cv::IMREAD_GRAYSCALE;
  }
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

std::optional<cv::Mat> decodeJpeg(const image_t& message, bool colour, int downscale) {
  const auto declared = jpegSize(message.data.data(), message.data.size());
  if (!declared || *declared != cv::Size(message.width, message.height)) return std::nullopt;
  if (!isWholeJpeg(message.data)) return std::nullopt;
  cv::Mat decoded = cv::imdecode(message.data, jpegFlags(colour, downscale));
  if (decoded.size() != *declared / downscale) return std::nullopt;
  return decoded;
}

/// The message's bytes as an image, without a copy.
std::optional<cv::Mat> viewRaw(const image_t& message, int channels) {
  const int64_t row = static_cast<int64_t>(message.width) * channels;
  if (message.row_stride < row || static_cast<int64_t>(message.row_stride) * message.height != message.size) {
    return std::nullopt;
  }
  // cv::Mat has no read-only view; the callers below only read.
  auto* data = const_cast<uint8_t*>(message.data.data());  // NOLINT(cppcoreguidelines-pro-type-const-cast)
  return cv::Mat(message.height, message.width, CV_8UC(channels), data,
                 static_cast<size_t>(message.row_stride));
}

std::optional<cv::Mat> convertRaw(const image_t& message, int channels, int code, int downscale) {
  const auto view = viewRaw(message, channels);
  if (!view) return std::nullopt;
  cv::Mat converted;
  if (code < 0) {
    view->copyTo(converted);
  } else {
    cv::cvtColor(*view, converted, code);
  }
  if (downscale > 1) cv::resize(converted, converted, view->size() / downscale, 0, 0, cv::INTER_AREA);
  return converted;
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
  if (!plausibleSize(message) || !canShrink(message, downscale)) return std::nullopt;
  switch (message.pixelformat) {
    case image_t::GRAY:
      return convertRaw(message, 1, -1, downscale);
    case image_t::RGB:
      return convertRaw(message, 3, cv::COLOR_RGB2GRAY, downscale);
    case image_t::BGR:
      return convertRaw(message, 3, cv::COLOR_BGR2GRAY, downscale);
    case image_t::MJPEG:
      return decodeJpeg(message, false, downscale);
    default:
      return std::nullopt;
  }
}

std::optional<cv::Mat3b> decodeColour(const image_t& message, int downscale) {
  if (!plausibleSize(message) || !canShrink(message, downscale)) return std::nullopt;
  switch (message.pixelformat) {
    case image_t::GRAY:
      return convertRaw(message, 1, cv::COLOR_GRAY2BGR, downscale);
    case image_t::RGB:
      return convertRaw(message, 3, cv::COLOR_RGB2BGR, downscale);
    case image_t::BGR:
      return convertRaw(message, 3, -1, downscale);
    case image_t::MJPEG:
      return decodeJpeg(message, true, downscale);
    default:
      return std::nullopt;
  }
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
  cv::imencode(".jpg", image, message.data, {cv::IMWRITE_JPEG_QUALITY, quality});
  message.size = static_cast<int32_t>(message.data.size());
  message.nmetadata = 0;
  return message;
}

std::vector<uint8_t> encodePng(const cv::Mat1b& map) {
  std::vector<uint8_t> bytes;
  // By default OpenCV compresses for speed; setting any level makes libpng try every filter on every row.
  cv::imencode(".png", map, bytes);
  return bytes;
}

std::vector<uint8_t> encodeBilevelPng(const cv::Mat1b& map) {
  std::vector<uint8_t> bytes;
  cv::imencode(".png", map, bytes, {cv::IMWRITE_PNG_BILEVEL, 1});
  return bytes;
}

}  // namespace redbee
