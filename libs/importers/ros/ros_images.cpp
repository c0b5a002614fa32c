#include "redbee/importers/ros/ros_images.hpp"

#include <string>
#include <utility>
#include <vector>

#include "redbee/bus/image.hpp"
#include "redbee/bus/raw_format.hpp"
#include "redbee/geometry/time.hpp"
#include "redbee/image_codec/image_codec.hpp"
#include "redbee/importers/ros/ros_encodings.hpp"
#include "redbee/importers/ros/ros_messages.hpp"

namespace redbee {
namespace {

constexpr uint32_t kMostPixels = 16384;  // a side, of an image_t

bool is16Bits(const std::string& encoding) { return encoding == "mono16" || encoding == "16UC1"; }

RosImage readImage(const RosMessage& message) {
  return readRosImage(message.topic->type, message.bytes, message.topic->encoding);
}

void requireSize(const RosImage& image) {
  if (image.width == 0 || image.height == 0 || image.width > kMostPixels || image.height > kMostPixels) {
    throw RosMessageError("has the size " + std::to_string(image.width) + "x" + std::to_string(image.height));
  }
  if (uint64_t{image.step} * image.height != image.data.size) {
    throw RosMessageError("has " + std::to_string(image.data.size) + " bytes of pixels, not " +
                          std::to_string(image.height) + " rows of " + std::to_string(image.step));
  }
}

cv::Mat values16(const RosImage& image) {
  requireSize(image);
  if (image.step < 2 * image.width) throw RosMessageError("has rows shorter than its width");
  cv::Mat1w values(static_cast<int>(image.height), static_cast<int>(image.width));
  for (int y = 0; y < values.rows; ++y) {
    const uint8_t* row = image.data.data + static_cast<size_t>(y) * image.step;
    for (int x = 0; x < values.cols; ++x) {
      const int first = row[2 * x], second = row[2 * x + 1];
      values(y, x) = static_cast<uint16_t>(image.is_big_endian ? first << 8 | second : second << 8 | first);
    }
  }
  return std::move(values);
}

image_t rawMessage(const RosImage& image, int32_t format, int64_t utime) {
  image_t message{};
  message.utime = utime;
  message.width = static_cast<int32_t>(image.width);
  message.height = static_cast<int32_t>(image.height);
  message.row_stride = static_cast<int32_t>(image.step);
  message.pixelformat = format;
  message.size = static_cast<int32_t>(image.data.size);
  message.data.assign(image.data.data, image.data.data + image.data.size);
  return message;
}

LoadedImage convertRaw(const RosImage& image, int64_t utime, const ImageOptions& options) {
  if (is16Bits(image.encoding)) {
    const cv::Mat1b grey = scaledTo8Bits(values16(image), options.range.value_or(GreyRange{}));
    return {rawGreyMessage(utime, grey), false};
  }
  const int32_t format = pixelFormatOf(image.encoding);
  if (format == 0)
    throw RosMessageError("has the encoding '" + image.encoding + "', which is not read: " + rosEncodings() +
                          ", mono16 and 16UC1 are");
  requireSize(image);
  const image_t raw = rawMessage(image, format, utime);
  const auto pixels = decodeRaw(raw, format != image_t::GRAY);
  if (!pixels) throw RosMessageError("has rows that do not fit its width and encoding");
  if (pixels->channels() == 1) return {rawGreyMessage(utime, *pixels), false};
  return {jpegMessage(utime, *pixels, options.jpeg_quality), false};
}

std::vector<uint8_t> copied(ByteView bytes) { return {bytes.data, bytes.data + bytes.size}; }

int64_t utimeOf(int64_t stamp_ns, const RosMessage& message) {
  return fromNanoseconds(stamp_ns != 0 ? stamp_ns : message.logged_ns).count();
}

RosCompressedImage readCompressed(const RosMessage& message) {
  return readRosCompressedImage(message.topic->type, message.bytes, message.topic->encoding);
}

}  // namespace

LoadedImage convertRosImage(const RosMessage& message, const std::filesystem::path& source,
                            const ImageOptions& options) {
  if (rosKindOf(message.topic->type) == RosKind::kImage) {
    const RosImage image = readImage(message);
    return convertRaw(image, utimeOf(image.stamp_ns, message), options);
  }
  const RosCompressedImage image = readCompressed(message);
  if (image.format.find("compressedDepth") != std::string::npos)
    throw RosMessageError("is a depth image, '" + image.format + "'");
  std::vector<uint8_t> bytes = copied(image.data);
  if (!isJpeg(bytes) && !isPng(bytes))
    throw RosMessageError("is neither JPEG nor PNG, but '" + image.format + "'");
  return imageOf(source, std::move(bytes), utimeOf(image.stamp_ns, message), options);
}

std::optional<cv::Mat> valuesOf16BitRosImage(const RosMessage& message, const std::filesystem::path& source) {
  if (rosKindOf(message.topic->type) == RosKind::kCompressedImage)
    return valuesOf16BitPng(source, copied(readCompressed(message).data));
  const RosImage image = readImage(message);
  if (!is16Bits(image.encoding)) return std::nullopt;
  return values16(image);
}

}  // namespace redbee
