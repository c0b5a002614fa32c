#include "redbee/imaging/chamfer_distance.hpp"

#include <algorithm>

namespace redbee {
namespace {

constexpr float kBeside = 0.955F, kDiagonal = 1.369F;
constexpr float kFar = 1e6F;  // px

/// Two passes; `beyond`: of the pixels outside of the map.
void propagate(cv::Mat1f& distance, float beyond) {
  const int last = distance.cols - 1;
  const auto relax = [&](const float* beside, float* row, int x) {
    const float left = x > 0 ? beside[x - 1] : beyond, right = x < last ? beside[x + 1] : beyond;
    row[x] = std::min({row[x], beside[x] + kBeside, left + kDiagonal, right + kDiagonal});
  };
  const auto relaxAtBorder = [&](float* row) {
    for (int x = 0; x <= last; ++x) row[x] = std::min(row[x], beyond + kBeside);
  };
  for (int y = 0; y < distance.rows; ++y) {
    float* const row = distance[y];
    if (y == 0) relaxAtBorder(row);
    for (int x = 0; x <= last; ++x) {
      if (y > 0) relax(distance[y - 1], row, x);
      row[x] = std::min(row[x], (x > 0 ? row[x - 1] : beyond) + kBeside);
    }
  }
  for (int y = distance.rows - 1; y >= 0; --y) {
    float* const row = distance[y];
    if (y == distance.rows - 1) relaxAtBorder(row);
    for (int x = last; x >= 0; --x) {
      if (y < distance.rows - 1) relax(distance[y + 1], row, x);
      row[x] = std::min(row[x], (x < last ? row[x + 1] : beyond) + kBeside);
    }
  }
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
