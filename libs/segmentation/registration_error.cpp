#include "segmentation/registration_error.hpp"

#include <Eigen/Cholesky>
#include <vector>

namespace redbee {
namespace {

using Vector6f = Eigen::Matrix<float, 6, 1>;
using Matrix6f = Eigen::Matrix<float, 6, 6>;

constexpr int kStep_px = 8;       // between the samples
constexpr int kIterations = 4;    // of the reweighting
constexpr float kRobustness = 2;  // residuals of more variances than this lose their weight (Geman-McClure)
constexpr float kPriorWeight = 4;

/// One component of the flow at one pixel, linear in the six entries of the affine flow.
struct Constraint {
  Vector6f jacobian;
  float residual;  ///< px, of no error at all
  float variance;  ///< px^2
};

/// Pixels in units of half the picture's width about its middle, so that all six entries are in pixels.
struct Centre {
  explicit Centre(cv::Size size)
      : x(0.5F * static_cast<float>(size.width)), y(0.5F * static_cast<float>(size.height)), scale(1 / x) {}
  float x, y, scale;
};

std::vector<Constraint> constraintsOf(const cv::Mat& flow, const cv::Mat& variance, const cv::Mat& unseen,
                                      const ParallaxSegment& segment, const Centre& centre) {
  std::vector<Constraint> constraints;
  for (int y = kStep_px / 2; y < flow.rows; y += kStep_px) {
    for (int x = kStep_px / 2; x < flow.cols; x += kStep_px) {
      if (unseen.at<uint8_t>(y, x) != 0) continue;
      const cv::Vec2f back = flow.at<cv::Vec2f>(y, x);
      const cv::Vec2f pixel(static_cast<float>(x), static_cast<float>(y));
      const float u = (pixel[0] - centre.x) * centre.scale;
      const float v = (pixel[1] - centre.y) * centre.scale;
      const auto add = [&](const cv::Vec2f& n) {
        Vector6f J;
        J << n[0] * u, n[0] * v, n[0], n[1] * u, n[1] * v, n[1];
        constraints.push_back({J, -n.dot(back), variance.at<float>(y, x)});
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

Vector6f solve(const std::vector<Constraint>& constraints, float expected_px) {
  const Matrix6f prior = kPriorWeight / (expected_px * expected_px) * Matrix6f::Identity();
  Vector6f solution = Vector6f::Zero();
  for (int i = 0; i < kIterations; ++i) {
    Matrix6f normal = prior;
    Vector6f right = Vector6f::Zero();
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

AffineFlow registrationError(const cv::Mat& flow, const cv::Mat& variance, const cv::Mat& unseen,
                             const ParallaxSegment& segment, float expected_px) {
  const Centre centre(flow.size());
  const Vector6f a = solve(constraintsOf(flow, variance, unseen, segment, centre), expected_px);
  AffineFlow error;
  for (int row = 0; row < 2; ++row) {
    const float du = a[3 * row] * centre.scale, dv = a[3 * row + 1] * centre.scale;
    error.A.row(row) << du, dv, a[3 * row + 2] - du * centre.x - dv * centre.y;
  }
  return error;
}

}  // namespace redbee
