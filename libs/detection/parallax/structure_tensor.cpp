#include "redbee/detection/parallax/structure_tensor.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

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
  cv::Mat1f by_x, by_y;
  cv::Sobel(grey, by_x, CV_32F, 1, 0, 3, 1 / kSobelGain);
  cv::Sobel(grey, by_y, CV_32F, 0, 1, 3, 1 / kSobelGain);
  cv::Mat3f products(grey.size());
  for (int y = 0; y < grey.rows; ++y) {
    for (int x = 0; x < grey.cols; ++x) {
      const float gx = by_x(y, x), gy = by_y(y, x);
      products(y, x) = {gx * gx, gx * gy, gy * gy};
    }
  }
  cv::blur(products, products, {window_px, window_px});
  return products;
}

/// The inverse of S + kNoGradient2 I is its adjugate over its determinant.
Symmetric2f displacementCovariance(const Symmetric2f& S, float variance, float min_gradient2) {
  const float xx = S[0] + kNoGradient2, yy = S[2] + kNoGradient2;
  const float determinant = (largestEigenvalue(S) + kNoGradient2) * (smallestEigenvalue(S) + kNoGradient2);
  const float scaled = variance * min_gradient2 / determinant;
  return {variance + scaled * yy, -scaled * S[1], variance + scaled * xx};
}

}  // namespace redbee
