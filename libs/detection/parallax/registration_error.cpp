#include "redbee/detection/parallax/registration_error.hpp"

#include <Eigen/Cholesky>

namespace redbee {
namespace {

using Vector8f = Eigen::Matrix<float, 8, 1>;
using Matrix8f = Eigen::Matrix<float, 8, 8>;

constexpr int kStep_px = 8;     // between the samples
constexpr int kIterations = 4;  // of the reweighting
constexpr float kRobustness =
    4;  // squared residuals beyond so many variances are down-weighted (Geman-McClure)
constexpr float kPriorWeight = 4;

}  // namespace

void HomographyFlowFit::add(const cv::Vec2f& pixel, const cv::Vec2f& normal, float measured_px,
                            float variance_px2) {
  const float u = (pixel[0] - units_.middle[0]) / units_.unit;
  const float v = (pixel[1] - units_.middle[1]) / units_.unit;
  const float outwards = normal[0] * u + normal[1] * v;
  Constraint constraint;
  constraint.jacobian << normal[0] * u, normal[0] * v, normal[0], normal[1] * u, normal[1] * v, normal[1],
      outwards * u, outwards * v;
  constraint.measured = measured_px;
  constraint.variance = variance_px2;
  constraints_.push_back(constraint);
}

HomographyFlow HomographyFlowFit::solve(float expected_px, int iterations) const {
  const Matrix8f prior = kPriorWeight / (expected_px * expected_px) * Matrix8f::Identity();
  Vector8f h = Vector8f::Zero();
  for (int i = 0; i < iterations; ++i) {
    Matrix8f normal = prior;
    Vector8f right = Vector8f::Zero();
    for (const Constraint& c : constraints_) {
      const float left = c.measured - c.jacobian.dot(h);
      const float doubt = 1 + left * left / (kRobustness * c.variance);
      const float weight = 1 / (c.variance * doubt * doubt);
      normal.noalias() += weight * c.jacobian * c.jacobian.transpose();
      right += weight * c.measured * c.jacobian;
    }
    h = normal.ldlt().solve(right);
  }
  HomographyFlow flow = units_;
  flow.affine << h[0], h[1], h[2], h[3], h[4], h[5];
  flow.perspective = {h[6], h[7]};
  return flow;
}

HomographyFlow registrationError(const cv::Mat2f& flow, const FlowCovariance& noise, const cv::Mat1b& unknown,
                                 const ParallaxSegment& segment, float expected_px) {
  HomographyFlowFit fit(flow.size());
  for (int y = kStep_px / 2; y < flow.rows; y += kStep_px) {
    for (int x = kStep_px / 2; x < flow.cols; x += kStep_px) {
      if (unknown(y, x) != 0) continue;
      const cv::Vec2f pixel(static_cast<float>(x), static_cast<float>(y));
      const cv::Vec2f& back = flow(y, x);
      const cv::Vec2f along = segment.direction(pixel + back);
      const float variance = noise.largest(y, x);
      if (along == cv::Vec2f(0, 0)) {
        fit.add(pixel, {1, 0}, -back[0], variance);
        fit.add(pixel, {0, 1}, -back[1], variance);
      } else {
        const cv::Vec2f across(-along[1], along[0]);
        fit.add(pixel, across, -across.dot(back), variance);
      }
    }
  }
  return fit.solve(expected_px, kIterations);
}

}  // namespace redbee
