#include "redbee/detection/parallax/evidence_kernels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "redbee/detection/foreground_maps.hpp"
#include "redbee/detection/parallax/parallax_segment.hpp"
#include "redbee/detection/parallax/propagated_evidence.hpp"
#include "redbee/detection/parallax/registration_error.hpp"
#include "tests/support/instruction_sets.hpp"

namespace redbee {
namespace {

constexpr int kWidth = 45;  // no multiple of any vector

class EvidenceKernels : public test::WithInstructions {};
REDBEE_WITH_INSTRUCTIONS(EvidenceKernels);

template <typename Map>
Map randomMap(int rows, uint64_t seed, double low, double high) {
  Map map(rows, kWidth);
  cv::RNG(seed).fill(map, cv::RNG::UNIFORM, low, high);
  return map;
}

struct ResidualCase {
  cv::Mat2f flow = randomMap<cv::Mat2f>(1, 1, -4, 4);
  cv::Mat3f upper = randomMap<cv::Mat3f>(1, 2, 0.5, 1), lower = randomMap<cv::Mat3f>(1, 3, 0.5, 1);
  cv::Mat1b unknown = randomMap<cv::Mat1b>(1, 4, 0, 4) == 0;
  HomographyFlow error{cv::Size(kWidth, 30)};
};

void expectScalarResiduals(const cv::Vec3f& epipole) {
  constexpr int kRow = 7;
  constexpr float kUpper = 0.25F, kLower = 0.75F;
  ResidualCase c;
  c.error.affine << 0.3F, -0.1F, 0.2F, 0.05F, 0.1F, -0.4F;
  c.error.perspective = {0.02F, -0.03F};
  for (cv::Mat3f* map : {&c.upper, &c.lower}) {
    for (Symmetric2f& C : *map) C[1] -= 0.7F;  // positive definite
  }
  std::vector<cv::Mat1f> upper, lower;
  cv::split(c.upper, upper);
  cv::split(c.lower, lower);
  cv::Mat2f residual(1, kWidth), nearest(1, kWidth), speed(1, kWidth);
  cv::Mat1f squared(1, kWidth);
  const SmoothFlow smooth{{c.error.middle[0], c.error.middle[1]},
                          c.error.unit,
                          {0.3F, -0.1F, 0.2F, 0.05F, 0.1F, -0.4F},
                          {0.02F, -0.03F}};
  ParallaxParameters parameters;
  const ParallaxSegment segment(epipole, parameters);
  residualRow(smooth, epipole.val, segment.directionVariance(),
              {kRow,
               kWidth,
               c.flow.ptr<float>(),
               {upper[0][0], upper[1][0], upper[2][0]},
               {lower[0][0], lower[1][0], lower[2][0]},
               kUpper,
               kLower,
               c.unknown[0],
               residual.ptr<float>(),
               squared[0],
               nearest.ptr<float>(),
               speed.ptr<float>()});
  for (int x = 0; x < kWidth; ++x) {
    const cv::Vec2f pixel(static_cast<float>(x), kRow), back = c.flow(0, x);
    const cv::Vec2f forth = -back - c.error.at(pixel[0], pixel[1]);
    const Symmetric2f noise = c.upper(0, x) * kUpper + c.lower(0, x) * kLower;
    const ParallaxSegment::Residual found = segment.residual(pixel + back, forth, noise);
    const bool is_known = c.unknown(0, x) == 0;
    ASSERT_EQ(residual(0, x), is_known ? found.normalized_residual : cv::Vec2f(0, 0)) << x;
    ASSERT_EQ(squared(0, x),
              is_known ? std::min(found.squaredMahalanobis(), kMostSquaredResidual) : kNotCompared);
    ASSERT_EQ(nearest(0, x), found.nearest);
    ASSERT_EQ(speed(0, x), cv::Vec2f(std::sqrt(forth.dot(forth)), largestEigenvalue(noise)));
  }
}

TEST_P(EvidenceKernels, ResidualsAreTheScalarOnes) {
  expectScalarResiduals({300, 200, 2});
  expectScalarResiduals({0, 0, 0});
  expectScalarResiduals({20, 7, 1});
}

/// One frame of equation (28), by OpenCV's functions and pixel by pixel.
cv::Mat4f propagatedByScalars(const cv::Mat4f& then, const FrameEvidence& now, const cv::Mat2f& residual,
                              const Eigen::Matrix3f& back, const ParallaxParameters& parameters) {
  cv::Mat2f places(then.size()), around;
  for (int y = 0; y < then.rows; ++y) {
    for (int x = 0; x < then.cols; ++x) {
      const float u = static_cast<float>(x) + now.flow(y, x)[0] * now.step;
      const float v = static_cast<float>(y) + now.flow(y, x)[1] * now.step;
      const float scale = 1 / (back(2, 0) * u + back(2, 1) * v + back(2, 2));
      places(y, x) = {(back(0, 0) * u + back(0, 1) * v + back(0, 2)) * scale,
                      (back(1, 0) * u + back(1, 1) * v + back(1, 2)) * scale};
    }
  }
  cv::Mat4f moving;
  cv::remap(then, moving, places, {}, cv::INTER_LINEAR, cv::BORDER_CONSTANT, cv::Scalar::all(0));
  cv::blur(residual, around, {3, 3});
  const auto half2 = static_cast<float>(parameters.evidence_sigmas * parameters.evidence_sigmas);
  const auto rate = static_cast<float>(parameters.evidence_rate);
  for (int y = 0; y < then.rows; ++y) {
    for (int x = 0; x < then.cols; ++x) {
      cv::Vec4f& sum = moving(y, x);
      const cv::Vec2f& off = residual(y, x);
      const float then2 = sum[1] * sum[1] + sum[2] * sum[2];
      const float kept = std::min(1.0F, (4 * around(y, x).dot(around(y, x)) + half2) / (then2 + half2));
      const float off2 = off.dot(off);
      sum =
          kept * (1 - rate) * sum + rate * cv::Vec4f(off2 / (off2 + half2), off[0], off[1], std::sqrt(off2));
    }
  }
  return moving;
}

TEST_P(EvidenceKernels, PropagationIsTheScalarOne) {
  constexpr int kRows = 21;
  const ParallaxParameters parameters;
  PropagatedEvidence evidence(parameters);
  SpareMaps spare;
  cv::Mat4f moving = cv::Mat4f::zeros(kRows, kWidth);
  Eigen::Matrix3d ground = Eigen::Matrix3d::Identity();
  ground(0, 2) = 1.7;
  ground(1, 0) = 0.02;
  ground(2, 0) = 1e-4;
  const Eigen::Matrix3f back = ground.inverse().cast<float>();
  for (uint64_t k = 0; k < 4; ++k) {
    const auto residual = randomMap<cv::Mat2f>(kRows, 10 + k, -5, 5);
    FrameEvidence now{[&](int y) { return residual[y]; }, randomMap<cv::Mat2f>(kRows, 20 + k, -9, 9), 0.5F};
    const cv::Mat1b unknown = randomMap<cv::Mat1b>(kRows, 30 + k, 0, 5) == 0;
    now.flow(3, 4) = {1e9F, std::numeric_limits<float>::quiet_NaN()};
    evidence.update(now, ground, unknown, spare);
    moving = propagatedByScalars(moving, now, residual, back, parameters);
    moving.setTo(cv::Scalar::all(0), unknown);
    for (int y = 0; y < kRows; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const cv::Vec4f& sum = moving(y, x);
        const float net2 = sum[1] * sum[1] + sum[2] * sum[2];
        const float coherence = net2 / (sum[3] * sum[3] + 1e-3F);
        const auto half2 = static_cast<float>(0.5 * parameters.evidence_sigmas * parameters.evidence_sigmas);
        ASSERT_FLOAT_EQ(evidence.motion()(y, x), std::sqrt(sum[0] * coherence * net2 / (net2 + half2)))
            << x << ' ' << y;
      }
    }
  }
}

}  // namespace
}  // namespace redbee
