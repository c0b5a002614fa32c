// Image files into image_t messages.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "redbee/image_t.hpp"

namespace redbee {

struct ImageOptions {
  bool lossless_grey = true;  ///< grey PNGs become raw GRAY (a JPEG would add noise that the flight did not
                              ///< have); false: MJPEG
  int jpeg_quality = 95;      ///< of what is encoded here
};

/// A JPEG keeps its bytes untouched; a PNG becomes raw grey or MJPEG. Throws InputError(naming the
/// file) where it is missing, cut short or no 8-bit image.
image_t loadImage(const std::filesystem::path& file, int64_t utime, const ImageOptions& options);

/// Refuses an image of another size than the first one's.
class ResolutionCheck {
 public:
  void check(const std::filesystem::path& file, const image_t& image);

 private:
  int width_ = 0;
  int height_ = 0;
};

}  // namespace redbee
