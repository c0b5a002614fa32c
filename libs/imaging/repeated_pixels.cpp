#include "redbee/imaging/repeated_pixels.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <opencv2/imgproc.hpp>

namespace redbee {
namespace {

constexpr int kTogether = 16;

}  // namespace

cv::Mat1b repeatedPixels(const cv::Mat1b& mask, cv::Size size) {
  cv::Mat1b repeated;
  if (!mask.empty() && size == mask.size() * 4)
    return repeatedPixels(repeatedPixels(mask, mask.size() * 2), size);
  if (size != mask.size() * 2) {
    cv::resize(mask, repeated, size, 0, 0, cv::INTER_NEAREST);
    return repeated;
  }
  repeated.create(size);
  for (int y = 0; y < mask.rows; ++y) {
    const uint8_t* from = mask[y];
    uint8_t* first = repeated[2 * y];
    int x = 0;
    // Copies, so that the compiler need not fear overlap.
    for (; x + kTogether <= mask.cols; x += kTogether) {
      std::array<uint8_t, kTogether> once{};
      std::array<uint8_t, 2 * kTogether> twice{};
      std::copy_n(from + x, kTogether, once.begin());
      for (size_t i = 0; i < kTogether; ++i) twice[2 * i] = twice[2 * i + 1] = once[i];
      std::copy_n(twice.begin(), 2 * kTogether, first + 2 * x);
    }
    for (; x < mask.cols; ++x) first[2 * x] = first[2 * x + 1] = from[x];
    std::copy_n(first, size.width, repeated[2 * y + 1]);
  }
  return repeated;
}

}  // namespace redbee
