#include "redbee/importers/image_file.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "redbee/bus/image.hpp"
#include "redbee/files/input_error.hpp"
#include "redbee/files/input_file.hpp"

namespace redbee {
namespace {

std::vector<uint8_t> readWhole(const std::filesystem::path& file) {
  requireFile(file);
  std::ifstream in(file, std::ios::binary);
  std::vector<uint8_t> bytes(static_cast<size_t>(std::filesystem::file_size(file)));
  in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!in) throw InputError(file, "cannot be read");
  if (bytes.empty()) throw InputError(file, "is an empty file");
  return bytes;
}

bool startsWith(const std::vector<uint8_t>& bytes, std::initializer_list<uint8_t> magic) {
  return bytes.size() >= magic.size() && std::equal(magic.begin(), magic.end(), bytes.begin());
}

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

/// Only a JPEG with EXIF data can state an orientation.
bool holdsExif(const std::vector<uint8_t>& bytes) {
  const std::string marker = "Exif";
  const auto end = bytes.begin() + static_cast<long>(std::min<size_t>(bytes.size(), 64 << 10));
  return std::search(bytes.begin(), end, marker.begin(), marker.end()) != end;
}

/// OpenCV applies the orientation, but does not say it: a small image shows whether it is one.
bool isTurnedByExif(const std::vector<uint8_t>& bytes) {
  if (!holdsExif(bytes)) return false;
  const cv::Mat shown = cv::imdecode(bytes, cv::IMREAD_REDUCED_GRAYSCALE_8);
  const cv::Mat stored = cv::imdecode(bytes, cv::IMREAD_REDUCED_GRAYSCALE_8 | cv::IMREAD_IGNORE_ORIENTATION);
  if (shown.empty() || stored.empty()) return false;
  return shown.size() != stored.size() || cv::norm(shown, stored, cv::NORM_INF) > 0;
}

LoadedImage loadJpeg(const std::filesystem::path& file, int64_t utime, std::vector<uint8_t> bytes,
                     const ImageOptions& options) {
  const bool is_turned = isTurnedByExif(bytes);
  LoadedImage loaded{untouchedJpeg(file, utime, std::move(bytes)), is_turned};
  if (!is_turned) return loaded;
  const cv::Mat image = cv::imdecode(loaded.message.data, cv::IMREAD_COLOR);
  if (image.empty()) throw InputError(file, "JPEG cannot be decoded");
  loaded.message = jpegMessage(utime, image, options.jpeg_quality);
  return loaded;
}

cv::Mat decodePng(const std::filesystem::path& file, const std::vector<uint8_t>& bytes) {
  // The decoder silently fills the rest of a truncated file with grey; the end chunk shows that it is
  // complete.
  const std::string end_chunk = "IEND";
  const auto tail = bytes.end() - static_cast<long>(std::min<size_t>(bytes.size(), 12));
  if (std::search(tail, bytes.end(), end_chunk.begin(), end_chunk.end()) == bytes.end()) {
    throw InputError(file, "PNG is cut short: no end chunk");
  }
  cv::Mat image = cv::imdecode(bytes, cv::IMREAD_UNCHANGED);
  if (image.empty()) throw InputError(file, "PNG cannot be decoded");
  if (image.channels() == 4) cv::cvtColor(image, image, cv::COLOR_BGRA2BGR);
  return image;
}

bool isPng(const std::vector<uint8_t>& bytes) { return startsWith(bytes, {0x89, 'P', 'N', 'G'}); }

/// By the header, without decoding.
bool isPng16(const std::vector<uint8_t>& bytes) {
  constexpr size_t kBitDepthAt = 24;
  return isPng(bytes) && bytes.size() > kBitDepthAt && bytes[kBitDepthAt] == 16;
}

}  // namespace

LoadedImage imageOf(const std::filesystem::path& source, std::vector<uint8_t> bytes, int64_t utime,
                    const ImageOptions& options) {
  if (startsWith(bytes, {0xFF, 0xD8})) return loadJpeg(source, utime, std::move(bytes), options);
  if (!isPng(bytes)) throw InputError(source, "is neither JPEG nor PNG");
  cv::Mat image = decodePng(source, bytes);
  if (image.depth() == CV_16U) image = scaledTo8Bits(image, options.range.value_or(GreyRange{}));
  if (image.channels() == 1 && options.lossless_grey) return {rawGreyMessage(utime, image), false};
  return {jpegMessage(utime, image, options.jpeg_quality), false};
}

LoadedImage loadImage(const std::filesystem::path& file, int64_t utime, const ImageOptions& options) {
  return imageOf(file, readWhole(file), utime, options);
}

std::optional<cv::Mat> valuesOf16BitPng(const std::filesystem::path& source,
                                        const std::vector<uint8_t>& bytes) {
  if (!isPng16(bytes)) return std::nullopt;
  return decodePng(source, bytes);
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
