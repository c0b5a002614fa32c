#include "redbee/detection/parallax/flow_covariance.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace redbee {
namespace {

constexpr double kQuarter = 4;
// Wider than a trunk or a post, the window holds the texture beside it, which says nothing of their flow.
constexpr int kWindow_px = 3;          // of the quarter-size image
constexpr double kSobelGain = 8;       // of a ramp of one grey level per px
constexpr float kNoGradient2 = 1e-3F;  // keeps the variance finite without texture

/// Mean of g g' over the window, g the gradient [grey levels per px].
cv::Mat3f gradientMatrix(const cv::Mat1b& grey) {
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
  cv::blur(products, products, {kWindow_px, kWindow_px});
  return products;
}

struct Eigenvalues {
  float largest, smallest;
};

Eigenvalues eigenvaluesOf(const Symmetric2f& S) {
  const float mean = 0.5F * (S[0] + S[2]), half = 0.5F * (S[0] - S[2]);
  const float radius = std::sqrt(half * half + S[1] * S[1]);
  return {mean + radius, std::max(mean - radius, 0.0F)};
}

}  // namespace

FlowTexture::FlowTexture(const cv::Mat1b& grey, double scale) : size_(grey.size()), scale_(scale) {
  cv::Mat1b quarter;
  cv::resize(grey, quarter, {}, scale / kQuarter, scale / kQuarter, cv::INTER_AREA);
  gradients_ = gradientMatrix(quarter);
}

cv::Mat3f FlowTexture::covariance(const FlowNoise& noise) const {
  cv::Mat3f covariance(gradients_.size());
  const auto variance = static_cast<float>(std::pow(noise.sigma_px / scale_, 2));
  const auto gradient2 = static_cast<float>(noise.min_gradient * noise.min_gradient);
  const auto covarianceOf = [&](const Symmetric2f& S) -> Symmetric2f {
    // The inverse of S + kNoGradient2 I is its adjugate over its determinant.
    const float xx = S[0] + kNoGradient2, yy = S[2] + kNoGradient2;
    const auto [largest, smallest] = eigenvaluesOf(S);
    const float scaled = variance * gradient2 / ((largest + kNoGradient2) * (smallest + kNoGradient2));
    return {variance + scaled * yy, -scaled * S[1], variance + scaled * xx};
  };
  std::transform(gradients_.begin(), gradients_.end(), covariance.begin(), covarianceOf);
  cv::resize(covariance, covariance, size_, 0, 0, cv::INTER_LINEAR);
  return covariance;
}

float largestVariance(const Symmetric2f& covariance) { return eigenvaluesOf(covariance).largest; }

cv::Mat1f largestVariance(const cv::Mat3f& covariance) {
  cv::Mat1f largest(covariance.size());
  std::transform(covariance.begin(), covariance.end(), largest.begin(),
                 [](const Symmetric2f& C) { return largestVariance(C); });
  return largest;
}

}  // namespace redbee
