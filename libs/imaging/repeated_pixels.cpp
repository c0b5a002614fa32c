#include "redbee/imaging/repeated_pixels.hpp"

#include <algorithm>
#include <cstdint>
#include <opencv2/imgproc.hpp>

namespace redbee {

cv::Mat1b repeatedPixels(const cv::Mat1b& mask, cv::Size size) {
  cv::Mat1b repeated;
  if (size != mask.size() * 2) {
    cv::resize(mask, repeated, size, 0, 0, cv::INTER_NEAREST);
    return repeated;
  }
  repeated.create(size);
  for (int y = 0; y < mask.rows; ++y) {
    const uint8_t* from = mask[y];
    uint8_t* first = repeated[2 * y];
    for (int x = 0; x < mask.cols; ++x) first[2 * x] = first[2 * x + 1] = from[x];
    std::copy_n(first, size.width, repeated[2 * y + 1]);
  }
  return repeated;
}

}  // namespace redbee
