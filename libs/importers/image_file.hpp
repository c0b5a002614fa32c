// Conversion of image files to image_t messages.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "redbee/image_t.hpp"

namespace redbee {

struct ImageOptions {
  bool lossless_grey = true;  ///< grey PNGs become raw GRAY (JPEG would add compression noise); false: MJPEG
  int jpeg_quality = 95;      ///< of images that are encoded here
};

/// A JPEG is copied unchanged; a PNG becomes raw grey or MJPEG. Throws InputError if the file is missing,
/// truncated or not an 8-bit image.
image_t loadImage(const std::filesystem::path& file, int64_t utime, const ImageOptions& options);

/// check() throws InputError for an image whose size differs from the first one's.
class ResolutionCheck {
 public:
  void check(const std::filesystem::path& file, const image_t& image);

 private:
  int width_ = 0;
  int height_ = 0;
};

}  // namespace redbee
