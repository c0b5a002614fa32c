#include "redbee/detection/parallax/structure_tensor.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "redbee/detection/parallax/flow_covariance_kernels.hpp"
#include "redbee/detection/parallax/structure_tensor_kernels.hpp"

namespace redbee {
namespace {

constexpr double kSobelGain = 8;       // of a ramp of one grey level per px
constexpr float kNoGradient2 = 1e-3F;  // keeps the variance finite without texture

float meanOf(const Symmetric2f& S) { return 0.5F * (S[0] + S[2]); }

/// Half the difference of the eigenvalues.
float radiusOf(const Symmetric2f& S) {
  const float half = 0.5F * (S[0] - S[2]);
  return std::sqrt(half * half + S[1] * S[1]);
}

}  // namespace

float largestEigenvalue(const Symmetric2f& S) { return meanOf(S) + radiusOf(S); }

float smallestEigenvalue(const Symmetric2f& S) { return std::max(meanOf(S) - radiusOf(S), 0.0F); }

/// The root is (S + r I) / t with r = sqrt(det S) and t = sqrt(tr S + 2 r).
Symmetric2f inverseRoot(const Symmetric2f& S) {
  const float r = std::sqrt(S[0] * S[2] - S[1] * S[1]);
  const float xx = S[0] + r, yy = S[2] + r;
  const float factor = std::sqrt(S[0] + S[2] + 2 * r) / (xx * yy - S[1] * S[1]);
  return {factor * yy, -factor * S[1], factor * xx};
}

cv::Mat3f structureTensor(const cv::Mat1b& grey, int window_px) {
  cv::Mat3f tensor(grey.size());
  forEachTensorRow(grey, window_px,
                   [&](int y, const Symmetric2f* row) { std::copy(row, row + grey.cols, tensor[y]); });
  return tensor;
}

void forEachTensorRow(const cv::Mat1b& grey, int window_px,
                      const std::function<void(int, const Symmetric2f*)>& visit) {
  constexpr int kWidest_px = 45;  // of the steepest gradients the sums still fit
  if (window_px < 1 || window_px > kWidest_px || window_px % 2 == 0)
    throw std::invalid_argument("structureTensor: the window must be odd, 1 to 45 px");
  const int width = grey.cols, radius = window_px / 2, side = 2 * radius + 1;
  const auto stride = static_cast<size_t>(width + 2 * radius);
  const auto mirrored = [](int at, int size) {
    return cv::borderInterpolate(at, size, cv::BORDER_REFLECT_101);
  };
  std::vector<int16_t> smooth(static_cast<size_t>(width) + 2), difference(smooth.size());
  std::vector<int32_t> sums(3 * stride, 0), products(3 * stride * static_cast<size_t>(side), 0);
  std::vector<Symmetric2f> row(static_cast<size_t>(width));
  for (int step = -radius; step < grey.rows + radius; ++step) {
    const int y = mirrored(step, grey.rows);
    const uint8_t* const rows[3] = {grey[mirrored(y - 1, grey.rows)], grey[y],
                                    grey[mirrored(y + 1, grey.rows)]};
    smoothAndDifference(rows, static_cast<size_t>(width), &smooth[1], &difference[1]);
    for (std::vector<int16_t>* values : {&smooth, &difference}) {
      values->front() = (*values)[static_cast<size_t>(mirrored(-1, width) + 1)];
      values->back() = (*values)[static_cast<size_t>(mirrored(width, width) + 1)];
    }
    const auto kept = static_cast<size_t>((step + radius) % side);
    slideTensorColumns(&smooth[1], &difference[1], static_cast<size_t>(width),
                       {&sums[static_cast<size_t>(radius)], &products[3 * stride * kept], stride});
    if (step < radius) continue;
    for (size_t entry = 0; entry < 3; ++entry) {
      int32_t* const inner = &sums[entry * stride + static_cast<size_t>(radius)];
      for (int k = 1; k <= radius; ++k) {
        inner[-k] = inner[mirrored(-k, width)];
        inner[width - 1 + k] = inner[mirrored(width - 1 + k, width)];
      }
    }
    sumTensorRow(sums.data(), stride, side, 1 / (kSobelGain * kSobelGain * side * side),
                 static_cast<size_t>(width), row.data()->val);
    visit(step - radius, row.data());
  }
}

/// The inverse of S + kNoGradient2 I is its adjugate over its determinant.
Symmetric2f displacementCovariance(const Symmetric2f& S, float variance, float min_gradient2) {
  const float xx = S[0] + kNoGradient2, yy = S[2] + kNoGradient2;
  const float mean = meanOf(S), radius = radiusOf(S);
  const float determinant = (mean + radius + kNoGradient2) * (std::max(mean - radius, 0.0F) + kNoGradient2);
  const float scaled = variance * min_gradient2 / determinant;
  return {variance + scaled * yy, -scaled * S[1], variance + scaled * xx};
}

void displacementCovariances(const cv::Mat3f& tensors, float variance, float min_gradient2,
                             cv::Mat3f& covariances) {
  for (int y = 0; y < tensors.rows; ++y)
    covariancesOfTensors(tensors.ptr<float>(y), static_cast<size_t>(tensors.cols), variance, min_gradient2,
                         kNoGradient2, covariances.ptr<float>(y));
}

}  // namespace redbee
