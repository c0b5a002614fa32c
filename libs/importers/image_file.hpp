// Conversion of image files to image_t messages.
#pragma once

#include <cstdint>
#include <filesystem>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "redbee/image_codec/jpeg.hpp"
#include "redbee/image_t.hpp"

namespace redbee {

/// Of a sequence of 16-bit images; what lies outside becomes 0 or 255.
struct GreyRange {
  double black = 0;
  double white = 65535;
};

struct ImageOptions {
  bool lossless_grey = true;  ///< grey PNGs become raw GRAY (JPEG would add compression noise); false: MJPEG
  int jpeg_quality = 95;      ///< of images that are encoded here
  std::optional<GreyRange> range;  ///< of 16-bit images, see rangeOf()
};

struct LoadedImage {
  image_t message;
  bool is_turned = false;  ///< as its EXIF orientation says
  ExifLens lens{};         ///< as its EXIF data says
};

/// A JPEG is copied unchanged, unless its EXIF orientation turns it; a PNG becomes raw grey or MJPEG, one of
/// 16 bits by `options.range`, an alpha channel is left out. Throws InputError if the file is missing,
/// truncated or neither JPEG nor PNG.
LoadedImage loadImage(const std::filesystem::path& file, int64_t utime, const ImageOptions& options);

/// The same from the bytes of such a file; `source` stands in the errors.
LoadedImage imageOf(const std::filesystem::path& source, std::vector<uint8_t> bytes, int64_t utime,
                    const ImageOptions& options);

/// The pixels of a 16-bit PNG, std::nullopt for anything else. Throws InputError as loadImage() does.
std::optional<cv::Mat> valuesOf16BitPng(const std::filesystem::path& source,
                                        const std::vector<uint8_t>& bytes);

/// `values`: 16 bits a channel.
cv::Mat scaledTo8Bits(const cv::Mat& values, const GreyRange& range);

/// The values of a sequence of 16-bit images.
class ValueHistogram {
 public:
  void add(const cv::Mat& values);
  /// All but 0.1 % at each end, where dead and saturated pixels lie.
  GreyRange range() const;

 private:
  std::vector<int64_t> counts_ = std::vector<int64_t>(1 << 16);
  int64_t total_ = 0;
};

/// The range of values of a sequence whose first image is a 16-bit PNG; otherwise std::nullopt. Reads every
/// file. Throws InputError.
std::optional<GreyRange> rangeOf(const std::vector<std::filesystem::path>& files);

/// check() throws InputError for an image whose size differs from the first one's.
class ResolutionCheck {
 public:
  void check(const std::filesystem::path& file, const image_t& image);

 private:
  int width_ = 0;
  int height_ = 0;
};

}  // namespace redbee
