#include "redbee/detection/parallax/propagated_evidence.hpp"

#include <gtest/gtest.h>

namespace redbee {
namespace {

const Eigen::Matrix3d kStill = Eigen::Matrix3d::Identity();

class PropagatedEvidenceTest : public testing::Test {
 protected:
  static constexpr int kSize = 48;

  /// Evidence of a square of 9 px at x that has moved by `off` standard deviations and `step` px.
  void see(int x, float off, float step) {
    cv::Mat2f residual = cv::Mat2f::zeros(kSize, kSize);
    const FrameEvidence now{[&](int y) { return residual[y]; }, cv::Mat2f::zeros(kSize, kSize)};
    const cv::Rect square(x, 20, 9, 9);
    residual(square).setTo(cv::Scalar(off, 0));
    cv::Mat2f(now.flow, square).setTo(cv::Scalar(-step, 0));
    evidence_.update(now, kStill, cv::Mat::zeros(kSize, kSize, CV_8U), spare_);
  }
  float motionAt(int x) const { return evidence_.motion().at<float>(24, x); }

  PropagatedEvidence evidence_{ParallaxParameters{}};
  SpareMaps spare_;
};

TEST_F(PropagatedEvidenceTest, SteadyMotionAccumulatesWithoutATrail) {
  for (int k = 0; k <= 20; ++k) see(4 + k, 8, 1);
  EXPECT_GT(motionAt(28), 0.7);
  EXPECT_LT(motionAt(15), 0.1) << "where it was ten frames ago";
}

TEST_F(PropagatedEvidenceTest, OscillationCancels) {
  for (int k = 0; k <= 20; ++k) see(20 + k % 2, k % 2 == 0 ? -8.0F : 8.0F, k % 2 == 0 ? -1.0F : 1.0F);
  EXPECT_LT(motionAt(24), 0.3);
}

}  // namespace
}  // namespace redbee
