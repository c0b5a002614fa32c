#include "redbee/importers/image_file.hpp"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "redbee/bus/image.hpp"
#include "redbee/files/input_error.hpp"
#include "redbee/files/input_file.hpp"
#include "redbee/image_codec/image_codec.hpp"
#include "redbee/image_codec/jpeg.hpp"
#include "redbee/image_codec/png.hpp"

namespace redbee {
namespace {

/// A JPEG ends with FF D9; some cameras pad with zeros behind it.
bool hasEndOfImage(const std::vector<uint8_t>& bytes) {
  const auto last = std::find_if(bytes.rbegin(), bytes.rend(), [](uint8_t byte) { return byte != 0; });
  return std::distance(last, bytes.rend()) >= 2 && *last == 0xD9 && *std::next(last) == 0xFF;
}

image_t untouchedJpeg(const std::filesystem::path& file, int64_t utime, std::vector<uint8_t> bytes) {
  const auto size = jpegSize(bytes.data(), bytes.size());
  if (!size || size->empty()) throw InputError(file, "JPEG header is damaged or cut short");
  if (!hasEndOfImage(bytes)) throw InputError(file, "JPEG is cut short: no end-of-image marker");
  image_t message{};
  message.utime = utime;
  message.width = size->width;
  message.height = size->height;
  message.pixelformat = image_t::MJPEG;
  message.size = static_cast<int32_t>(bytes.size());
  message.data = std::move(bytes);
  return message;
}

LoadedImage loadJpeg(const std::filesystem::path& file, int64_t utime, std::vector<uint8_t> bytes,
                     const ImageOptions& options) {
  const int orientation = jpegOrientation(bytes);
  const bool is_turned = orientation != 1;
  const ExifLens lens = jpegLens(bytes);
  LoadedImage loaded{untouchedJpeg(file, utime, std::move(bytes)), is_turned, lens};
  if (!is_turned) return loaded;
  const cv::Mat image = decodeJpeg(loaded.message.data, true);
  if (image.empty()) throw InputError(file, "JPEG cannot be decoded");
  loaded.message = jpegMessage(utime, upright(image, orientation), options.jpeg_quality);
  return loaded;
}

cv::Mat decodeWholePng(const std::filesystem::path& file, const std::vector<uint8_t>& bytes) {
  const std::string end_chunk = "IEND";
  const auto tail = bytes.end() - static_cast<long>(std::min<size_t>(bytes.size(), 12));
  if (std::search(tail, bytes.end(), end_chunk.begin(), end_chunk.end()) == bytes.end()) {
    throw InputError(file, "PNG is cut short: no end chunk");
  }
  cv::Mat image = decodePng(bytes);
  if (image.empty()) throw InputError(file, "PNG cannot be decoded");
  return image;
}

/// By the header, without decoding.
bool isPng16(const std::vector<uint8_t>& bytes) {
  constexpr size_t kBitDepthAt = 24;
  return isPng(bytes) && bytes.size() > kBitDepthAt && bytes[kBitDepthAt] == 16;
}

}  // namespace

LoadedImage imageOf(const std::filesystem::path& source, std::vector<uint8_t> bytes, int64_t utime,
                    const ImageOptions& options) {
  if (isJpeg(bytes)) return loadJpeg(source, utime, std::move(bytes), options);
  if (!isPng(bytes)) throw InputError(source, "is neither JPEG nor PNG");
  cv::Mat image = decodeWholePng(source, bytes);
  if (image.depth() == CV_16U) image = scaledTo8Bits(image, options.range.value_or(GreyRange{}));
  if (image.channels() == 1 && options.lossless_grey) return {rawGreyMessage(utime, image), false, {}};
  return {jpegMessage(utime, image, options.jpeg_quality), false, {}};
}

LoadedImage loadImage(const std::filesystem::path& file, int64_t utime, const ImageOptions& options) {
  std::vector<uint8_t> bytes = readWhole(file);
  if (bytes.empty()) throw InputError(file, "is an empty file");
  return imageOf(file, std::move(bytes), utime, options);
}

std::optional<cv::Mat> valuesOf16BitPng(const std::filesystem::path& source,
                                        const std::vector<uint8_t>& bytes) {
  if (!isPng16(bytes)) return std::nullopt;
  return decodeWholePng(source, bytes);
}

cv::Mat scaledTo8Bits(const cv::Mat& values, const GreyRange& range) {
  const double scale = 255 / (range.white - range.black);
  cv::Mat image;
  values.convertTo(image, CV_8U, scale, -scale * range.black);
  return image;
}

void ValueHistogram::add(const cv::Mat& values) {
  const cv::Mat single = values.reshape(1);
  for (int row = 0; row < single.rows; ++row) {
    const auto* pixels = single.ptr<uint16_t>(row);
    for (int column = 0; column < single.cols; ++column) ++counts_[pixels[column]];
  }
  total_ += static_cast<int64_t>(single.total());
}

GreyRange ValueHistogram::range() const {
  const auto valueAt = [&](double fraction) {
    int64_t below = 0;
    size_t value = 0;
    while (value + 1 < counts_.size() && (below += counts_[value]) <= fraction * static_cast<double>(total_))
      ++value;
    return static_cast<double>(value);
  };
  constexpr double kEnd = 1e-3;
  const GreyRange range{valueAt(kEnd), valueAt(1 - kEnd)};
  return range.white > range.black ? range : GreyRange{range.black, range.black + 255};
}

std::optional<GreyRange> rangeOf(const std::vector<std::filesystem::path>& files) {
  if (files.empty() || !isPng16(readWhole(files.front()))) return std::nullopt;
  ValueHistogram histogram;
  for (const std::filesystem::path& file : files) {
    const auto values = valuesOf16BitPng(file, readWhole(file));
    if (!values) throw InputError(file, "is no 16-bit PNG, as the images before it are");
    histogram.add(*values);
  }
  return histogram.range();
}

void ResolutionCheck::check(const std::filesystem::path& file, const image_t& image) {
  if (width_ == 0) {
    width_ = image.width;
    height_ = image.height;
  }
  if (image.width != width_ || image.height != height_) {
    throw InputError(file, "is " + std::to_string(image.width) + "x" + std::to_string(image.height) +
                               " px, the images before it " + std::to_string(width_) + "x" +
                               std::to_string(height_));
  }
}

}  // namespace redbee
