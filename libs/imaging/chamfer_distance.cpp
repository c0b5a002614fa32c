#include "redbee/imaging/chamfer_distance.hpp"

#include "redbee/imaging/chamfer_kernels.hpp"

namespace redbee {
namespace {

constexpr float kBeside = 0.955F, kDiagonal = 1.369F;
constexpr float kFar = 1e6F;  // px

/// `beyond`: of the pixels outside of the map.
void propagate(cv::Mat1f& distance, float beyond) {
  propagateDistances({distance[0], distance.step1(), distance.cols, distance.rows},
                     {kBeside, kDiagonal, beyond});
}

}  // namespace

void distanceOutside(const cv::Rect& box, const cv::Mat1b& pixels, cv::Mat1f distance) {
  distance.setTo(kFar);
  distance(box).setTo(0, pixels);
  propagate(distance, kFar);
}

void distanceInside(const cv::Mat1b& pixels, cv::Mat1f distance) {
  for (int y = 0; y < pixels.rows; ++y) {
    const uint8_t* const in = pixels[y];
    float* const out = distance[y];
    for (int x = 0; x < pixels.cols; ++x) out[x] = in[x] != 0 ? kFar : 0;
  }
  propagate(distance, 0);
}

}  // namespace redbee
