#include "redbee/detection/parallax/static_match.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace redbee {
namespace {

constexpr int kRadius = 2;  // px, of a patch
constexpr int kPatch = (2 * kRadius + 1) * (2 * kRadius + 1);
constexpr float kSteps_px = 0.5F;
constexpr int kMaxSteps = 64;
constexpr float kDoubt2 = 1;  // squared sigmas: below it there is nothing to ask
constexpr float kOutside = std::numeric_limits<float>::max();

}  // namespace

StaticMatch::StaticMatch(const cv::Mat1b& grey, const cv::Mat1b& reference, const cv::Mat2f& flow,
                         const HomographyFlow& error, const ParallaxSegment& segment)
    : grey_(grey), reference_(reference), flow_(flow), error_(error), segment_(segment) {}

/// Of the patch at (x, y) and that of the reference image; each less its mean.
float StaticMatch::difference(int x, int y, float reference_x, float reference_y) const {
  const int left = static_cast<int>(std::floor(reference_x)), top = static_cast<int>(std::floor(reference_y));
  if (left < kRadius || top < kRadius || left + kRadius + 1 >= reference_.cols ||
      top + kRadius + 1 >= reference_.rows)
    return kOutside;
  const float fx = reference_x - static_cast<float>(left), fy = reference_y - static_cast<float>(top);
  const float w11 = fx * fy, w10 = fy - w11, w01 = fx - w11, w00 = 1 - fx - fy + w11;
  float sum = 0, squares = 0;
  for (int v = -kRadius; v <= kRadius; ++v) {
    const uchar* now = grey_[y + v] + x;
    const uchar* upper = reference_[top + v] + left;
    const uchar* lower = reference_[top + v + 1] + left;
    for (int u = -kRadius; u <= kRadius; ++u) {
      const float then = w00 * upper[u] + w01 * upper[u + 1] + w10 * lower[u] + w11 * lower[u + 1];
      const float d = static_cast<float>(now[u]) - then;
      sum += d;
      squares += d * d;
    }
  }
  return squares - sum * sum / kPatch;
}

float StaticMatch::bestStatic(int x, int y) const {
  const cv::Vec2f pixel(static_cast<float>(x), static_cast<float>(y));
  const cv::Vec2f start = pixel - error_.at(pixel[0], pixel[1]);
  const auto [direction, length] = segment_.ray(start);
  float best = difference(x, y, start[0], start[1]);
  const int steps = std::min(kMaxSteps, static_cast<int>(std::ceil(length / kSteps_px)));
  for (int i = 1; i <= steps; ++i) {
    const cv::Vec2f at = start - std::min(length, kSteps_px * static_cast<float>(i)) * direction;
    const float d = difference(x, y, at[0], at[1]);
    best = std::min(best, d);
  }
  return best;
}

/// What the patch would differ by if it had moved off the segment as the flow says: its gradients times that
/// displacement, squared.
float StaticMatch::expected(int x, int y, const cv::Vec2f& back) const {
  const cv::Vec2f pixel(static_cast<float>(x), static_cast<float>(y));
  const cv::Vec2f forth = -back - error_.at(pixel[0], pixel[1]);
  const cv::Vec2f off = forth - segment_.residual(pixel + back, forth, 1).nearest;
  float sum = 0, squares = 0;
  for (int v = -kRadius; v <= kRadius; ++v) {
    const uchar* above = grey_[std::max(0, y + v - 1)] + x;
    const uchar* row = grey_[y + v] + x;
    const uchar* below = grey_[std::min(grey_.rows - 1, y + v + 1)] + x;
    for (int u = -kRadius; u <= kRadius; ++u) {
      const int left = std::max(-x, u - 1), right = std::min(grey_.cols - 1 - x, u + 1);
      const float d = 0.5F * (off[0] * static_cast<float>(row[right] - row[left]) +
                              off[1] * static_cast<float>(below[u] - above[u]));
      sum += d;
      squares += d * d;
    }
  }
  return squares - sum * sum / kPatch;
}

/// Of a difference of two grey levels, from pixels that are certainly static.
float StaticMatch::noiseVariance(const cv::Mat2f& normalized_residual, const cv::Mat1b& unknown) const {
  constexpr int kStep = 9;
  std::vector<float> squares;
  for (int y = kRadius + kStep / 2; y < grey_.rows - kRadius; y += kStep) {
    for (int x = kRadius + kStep / 2; x < grey_.cols - kRadius; x += kStep) {
      const cv::Vec2f& r = normalized_residual(y, x);
      if (unknown(y, x) != 0 || r.dot(r) > kDoubt2) continue;
      const cv::Vec2f& back = flow_(y, x);
      const float d = difference(x, y, static_cast<float>(x) + back[0], static_cast<float>(y) + back[1]);
      if (d < kOutside) squares.push_back(d / (kPatch - 1));
    }
  }
  constexpr float kLeast = 1;  // grey levels^2: quantisation of both images
  if (squares.empty()) return kLeast;
  const auto middle = squares.begin() + static_cast<long>(squares.size() / 2);
  std::nth_element(squares.begin(), middle, squares.end());
  return std::max(kLeast, *middle);
}

void StaticMatch::reduce(cv::Mat2f& normalized_residual, const cv::Mat1b& unknown) {
  const float variance = noiseVariance(normalized_residual, unknown);
  for (int y = kRadius; y < grey_.rows - kRadius; ++y) {
    cv::Vec2f* residual = normalized_residual[y];
    for (int x = kRadius; x < grey_.cols - kRadius; ++x) {
      const float squared = residual[x].dot(residual[x]);
      if (squared <= kDoubt2 || unknown(y, x) != 0) continue;
      const cv::Vec2f& back = flow_(y, x);
      const float by_flow =
          difference(x, y, static_cast<float>(x) + back[0], static_cast<float>(y) + back[1]);
      const float by_static = bestStatic(x, y);
      if (by_static == kOutside) continue;
      const float local = std::clamp(std::min(by_flow, by_static) / (kPatch - 1), 1.0F, variance);
      const float ratio = std::max(0.0F, by_static - std::min(by_flow, by_static)) / local;
      if (ratio >= squared) continue;
      const float weight = std::min(1.0F, expected(x, y, back) / local / squared);
      residual[x] *= std::sqrt(1 - weight * (1 - ratio / squared));
    }
  }
}

}  // namespace redbee
