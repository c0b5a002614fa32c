#include "redbee/detection/parallax/registration_error.hpp"

#include <Eigen/Cholesky>
#include <vector>

namespace redbee {
namespace {

using Vector8f = Eigen::Matrix<float, 8, 1>;
using Matrix8f = Eigen::Matrix<float, 8, 8>;

constexpr int kStep_px = 8;     // between the samples
constexpr int kIterations = 4;  // of the reweighting
constexpr float kRobustness =
    4;  // squared residuals beyond so many variances are down-weighted (Geman-McClure)
constexpr float kPriorWeight = 4;

/// One component of the flow at one pixel, linear in the eight entries of the homography's.
struct Constraint {
  Vector8f jacobian;
  float residual;  ///< px, for zero registration error
  float variance;  ///< px^2
};

std::vector<Constraint> constraintsOf(const cv::Mat2f& flow, const FlowCovariance& noise,
                                      const cv::Mat1b& unknown, const ParallaxSegment& segment) {
  const HomographyFlow units(flow.size());
  std::vector<Constraint> constraints;
  for (int y = kStep_px / 2; y < flow.rows; y += kStep_px) {
    for (int x = kStep_px / 2; x < flow.cols; x += kStep_px) {
      if (unknown(y, x) != 0) continue;
      const cv::Vec2f& back = flow(y, x);
      const cv::Vec2f pixel(static_cast<float>(x), static_cast<float>(y));
      const float u = (pixel[0] - units.middle[0]) / units.unit;
      const float v = (pixel[1] - units.middle[1]) / units.unit;
      const float variance = noise.largest(y, x);
      const auto add = [&](const cv::Vec2f& n) {
        Vector8f J;
        const float outwards = n[0] * u + n[1] * v;
        J << n[0] * u, n[0] * v, n[0], n[1] * u, n[1] * v, n[1], outwards * u, outwards * v;
        constraints.push_back({J, -n.dot(back), variance});
      };
      const cv::Vec2f along = segment.direction(pixel + back);
      if (along == cv::Vec2f(0, 0)) {
        add({1, 0});
        add({0, 1});
      } else {
        add({-along[1], along[0]});
      }
    }
  }
  return constraints;
}

Vector8f solve(const std::vector<Constraint>& constraints, float expected_px) {
  const Matrix8f prior = kPriorWeight / (expected_px * expected_px) * Matrix8f::Identity();
  Vector8f solution = Vector8f::Zero();
  for (int i = 0; i < kIterations; ++i) {
    Matrix8f normal = prior;
    Vector8f right = Vector8f::Zero();
    for (const Constraint& c : constraints) {
      const float left = c.residual - c.jacobian.dot(solution);
      const float doubt = 1 + left * left / (kRobustness * c.variance);
      const float weight = 1 / (c.variance * doubt * doubt);
      normal.noalias() += weight * c.jacobian * c.jacobian.transpose();
      right += weight * c.residual * c.jacobian;
    }
    solution = normal.ldlt().solve(right);
  }
  return solution;
}

}  // namespace

HomographyFlow registrationError(const cv::Mat2f& flow, const FlowCovariance& noise, const cv::Mat1b& unknown,
                                 const ParallaxSegment& segment, float expected_px) {
  const Vector8f h = solve(constraintsOf(flow, noise, unknown, segment), expected_px);
  HomographyFlow error(flow.size());
  error.affine << h[0], h[1], h[2], h[3], h[4], h[5];
  error.perspective = {h[6], h[7]};
  return error;
}

}  // namespace redbee
