// A small JPEG of an image that no camera of ours takes.
#pragma once

#include <opencv2/core.hpp>

#include "redbee/bus/image.hpp"

namespace redbee::test {

/// 16384x16384: 268 MB for whoever decodes it. Takes a second to make, once.
inline const image_t& hugeImage() {
  static const image_t image = jpegMessage(0, cv::Mat1b(16384, 16384, uchar{90}), 80);
  return image;
}

}  // namespace redbee::test
