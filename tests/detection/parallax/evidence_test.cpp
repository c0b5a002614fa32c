#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "redbee/detection/parallax/parallax_evidence.hpp"
#include "redbee/detection/parallax/parallax_segment.hpp"
#include "redbee/detection/parallax/travelling_evidence.hpp"
#include "redbee/detection/two_planes/flow_entropy.hpp"
#include "redbee/detection/two_planes/foreground_probability.hpp"
#include "redbee/geometry/so3.hpp"
#include "redbee/imaging/guided_filter.hpp"

namespace redbee {
namespace {

const Eigen::Matrix3d kStill = Eigen::Matrix3d::Identity();
constexpr int kGrid_px = 24;

TEST(FlowEntropy, OfAHistogram) {
  EXPECT_DOUBLE_EQ(histogramEntropy({7, 0, 0, 0}), 0);
  EXPECT_DOUBLE_EQ(histogramEntropy({3, 3, 3, 3}), 2);
  EXPECT_DOUBLE_EQ(histogramEntropy({0, 0}), 0);
}

PointTracks cellOf(double flow_px, bool coherent) {
  PointTracks tracks;
  for (int i = 0; i < 16; ++i) {
    const double angle = coherent ? 0.1 : 2 * M_PI * (i + 0.5) / 16;
    const int column = i % 4, row = i / 4;
    const cv::Point2f before(static_cast<float>(8 + 16 * column), static_cast<float>(8 + 16 * row));
    tracks.previous.push_back(before);
    tracks.current.emplace_back(before.x + static_cast<float>(flow_px * std::cos(angle)),
                                before.y + static_cast<float>(flow_px * std::sin(angle)));
  }
  return tracks;
}

TEST(FlowEntropy, OrderedFlowScoresOneAndDisorderedFlowLittle) {
  const RefinementParameters parameters;
  const cv::Size image(64, 64);
  EXPECT_FLOAT_EQ(flowOrder(cellOf(2, true), kGrid_px, kStill, image, parameters).at<float>(30, 30), 1);
  const double flattest = parameters.entropy_floor / std::log2(parameters.entropy_bins);
  EXPECT_LT(flowOrder(cellOf(2, false), kGrid_px, kStill, image, parameters).at<float>(30, 30),
            1.1 * flattest);
}

TEST(FlowEntropy, FlowBelowTheNoiseHasNoDirection) {
  const RefinementParameters parameters;
  const float order =
      flowOrder(cellOf(0.5 * parameters.flow_noise_px, true), kGrid_px, kStill, {64, 64}, parameters)
          .at<float>(30, 30);
  EXPECT_FLOAT_EQ(order, static_cast<float>(parameters.entropy_floor / std::log2(parameters.entropy_bins)));
}

TEST(FlowEntropy, ACellWithoutTracksHasNoEntropy) {
  EXPECT_FLOAT_EQ(flowOrder(cellOf(2, false), kGrid_px, kStill, {128, 64}, {}).at<float>(30, 100), 1);
}

TEST(ForegroundProbability, FollowsTheEquations) {
  const RefinementParameters p;
  ForegroundProbability probability(p);
  const cv::Mat foreground = cv::Mat::ones(20, 20, CV_32F);
  const cv::Mat order(20, 20, CV_32F, cv::Scalar(0.5));
  double temporal = 0, spatial = 0, entropy = 0;
  for (int k = 0; k < 3; ++k) {
    temporal = (1 - p.alpha) * temporal + p.alpha;
    spatial = (1 - p.beta) * spatial + p.beta;
    entropy = (1 - p.gamma) * entropy + p.gamma * 0.5;
    EXPECT_NEAR(probability.update(foreground, order).at<float>(10, 10), temporal * spatial * entropy, 1e-5);
  }
}

TEST(ForegroundProbability, MapsTravelWithTheGround) {
  ForegroundProbability probability({});
  cv::Mat foreground = cv::Mat::zeros(40, 40, CV_32F);
  foreground(cv::Rect(10, 10, 10, 10)).setTo(1);
  probability.update(foreground, {});
  Eigen::Matrix3d pan = kStill;
  pan(0, 2) = 7;
  probability.carry(pan);
  cv::Mat moved = cv::Mat::zeros(40, 40, CV_32F);
  const cv::Mat after = probability.update(moved, {});
  EXPECT_GT(after.at<float>(15, 22), 0);
  EXPECT_EQ(after.at<float>(15, 11), 0);
}

constexpr float kNoiseVariance = 0.25F;

class Parallax : public testing::Test {
 protected:
  Parallax() {
    K_ << 500, 0, 320, 0, 500, 240, 0, 0, 1;
    const Eigen::Vector3d down = Eigen::Vector3d(0, std::cos(0.6), std::sin(0.6));
    motion_ = {expSO3({0.01, -0.02, 0.005}), {0.1, -0.02, 0.15}, down, 6.0};
  }
  Eigen::Vector2d project(const Eigen::Vector3d& X) const { return (K_ * X).hnormalized(); }

  ParallaxSegment::Residual residual(const Eigen::Vector2d& before, const Eigen::Vector2d& now) const {
    const Eigen::Vector2d ground = transfer(planeHomography(K_, motion_), before);
    const Eigen::Vector2d flow = now - ground;
    return ParallaxSegment(motion_, K_, {})
        .residual({static_cast<float>(ground.x()), static_cast<float>(ground.y())},
                  {static_cast<float>(flow.x()), static_cast<float>(flow.y())}, kNoiseVariance);
  }

  Eigen::Matrix3d K_;
  PlaneMotion motion_;
};

TEST_F(Parallax, StaticPointsAtAnyDepthBeforeTheGroundAreExplained) {
  for (const double share : {0.3, 0.5, 0.8, 1.0}) {
    const Eigen::Vector3d ray = K_.inverse() * Eigen::Vector3d(150, 300, 1);
    const Eigen::Vector3d X = share * motion_.h_a / motion_.m_a.dot(ray) * ray;
    const Eigen::Vector2d now = project(motion_.R_ba * X + motion_.t_ba);
    EXPECT_LT(residual({150, 300}, now).squaredMahalanobis(), 0.01)
        << "at " << share << " of the way to the ground";
  }
}

TEST_F(Parallax, MotionAcrossTheLineOrBelowTheGroundIsNot) {
  const Eigen::Vector3d ray = K_.inverse() * Eigen::Vector3d(150, 300, 1);
  const Eigen::Vector3d X = motion_.h_a / motion_.m_a.dot(ray) * ray;
  const Eigen::Vector2d ground = project(motion_.R_ba * X + motion_.t_ba);
  const Eigen::Vector2d nearer = project(motion_.R_ba * (0.5 * X) + motion_.t_ba);
  const Eigen::Vector2d along = (nearer - ground).normalized();
  const Eigen::Vector2d across(-along.y(), along.x());
  EXPECT_GT(residual({150, 300}, ground + 3 * across).squaredMahalanobis(), 30);
  EXPECT_GT(residual({150, 300}, ground - 3 * along).squaredMahalanobis(), 20);
}

TEST_F(Parallax, ASecondPlaneShowsWhereStaticSurfacesGo) {
  const Eigen::Matrix3d ground = planeHomography(K_, motion_);
  PlaneMotion facade = motion_;
  facade.m_a = Eigen::Vector3d(0, 0, 1);
  facade.h_a = 5;
  const ParallaxSegment segment(ground, planeHomography(K_, facade), {});
  const Eigen::Vector2d before(320, 100);
  const Eigen::Vector2d on_ground = transfer(ground, before);
  const auto sigmas = [&](double depth, const Eigen::Vector2d& moved) {
    const Eigen::Vector3d X = depth * (K_.inverse() * before.homogeneous());
    const Eigen::Vector2d flow = project(motion_.R_ba * X + motion_.t_ba) + moved - on_ground;
    return segment
        .residual({static_cast<float>(on_ground.x()), static_cast<float>(on_ground.y())},
                  {static_cast<float>(flow.x()), static_cast<float>(flow.y())}, kNoiseVariance)
        .squaredMahalanobis();
  };
  const Eigen::Vector2d parallax = transfer(planeHomography(K_, facade), before) - on_ground;
  const Eigen::Vector2d across = Eigen::Vector2d(-parallax.y(), parallax.x()).normalized();
  EXPECT_LT(sigmas(5, {0, 0}), 0.01) << "on the facade";
  EXPECT_LT(sigmas(6, {0, 0}), 0.1) << "behind it";
  EXPECT_GT(sigmas(5, 4 * across), 10) << "moves";
}

/// Points of a 16-px grid, those in `front` displaced by 5 px, the others still.
PointTracks tracksWithFront(const cv::Rect& front) {
  PointTracks tracks;
  for (int y = 8; y < 480; y += 16) {
    for (int x = 8; x < 640; x += 16) {
      const auto before = cv::Point2f(static_cast<float>(x), static_cast<float>(y));
      tracks.previous.push_back(before);
      tracks.current.push_back(before + (front.contains({x, y}) ? cv::Point2f(5, 0) : cv::Point2f(0, 0)));
    }
  }
  return tracks;
}

TEST(RunsOutOfImage, StructuresDoAndIslandsDoNot) {
  Eigen::Matrix3d shift = kStill;
  shift(0, 2) = 5;
  const cv::Size image(640, 480);
  EXPECT_TRUE(runsOutOfImage(tracksWithFront({0, 300, 640, 180}), kStill, shift, image));
  EXPECT_FALSE(runsOutOfImage(tracksWithFront({200, 150, 200, 150}), kStill, shift, image));
  EXPECT_FALSE(runsOutOfImage(tracksWithFront({}), kStill, shift, image)) << "nothing follows it";
}

/// The flow [px] in the middle of a square of 10 px that has moved 3 px to the right over still ground.
cv::Vec2f flowOfSmallMover(int work_downscale, int flow_downscale) {
  cv::Mat ground(160, 160, CV_8U), paint(10, 10, CV_8U);
  cv::RNG random(7);
  random.fill(ground, cv::RNG::UNIFORM, 0, 255);
  cv::GaussianBlur(ground, ground, {0, 0}, 2);
  random.fill(paint, cv::RNG::UNIFORM, 128, 255);
  cv::GaussianBlur(paint, paint, {0, 0}, 1);
  cv::Mat then = ground.clone(), now = ground.clone(), flow;
  paint.copyTo(then(cv::Rect(70, 75, 10, 10)));
  paint.copyTo(now(cv::Rect(73, 75, 10, 10)));
  ParallaxParameters parameters;
  parameters.work_downscale = work_downscale;
  parameters.flow_downscale = flow_downscale;
  makeMotionFlow(parameters)->calc(now, then, flow);
  EXPECT_EQ(flow.size(), now.size());
  return flow.at<cv::Vec2f>(80, 78);
}

TEST(MotionFlow, AFinerOneSeesAMoverThatAPatchOfACoarserOneHides) {
  EXPECT_LT(cv::norm(flowOfSmallMover(1, 1) - cv::Vec2f(-3, 0)), 0.5);
  EXPECT_GT(cv::norm(flowOfSmallMover(1, 4) - cv::Vec2f(-3, 0)), 1.5);
}

TEST(MotionFlow, NoFinerThanTheImageThatItIsFor) {
  EXPECT_EQ(flowOfSmallMover(2, 1), flowOfSmallMover(2, 2));
  EXPECT_EQ(flowOfSmallMover(4, 1), flowOfSmallMover(4, 2));
}

TEST(GuidedFilter, KeepsToTheEdgesOfTheImage) {
  cv::Mat image(40, 40, CV_8U, cv::Scalar(60));
  image.colRange(20, 40).setTo(180);
  cv::Mat map = cv::Mat::zeros(40, 40, CV_32F);
  map.colRange(22, 40).setTo(1);
  const cv::Mat filtered = guidedFilter(image, map, 4, 10);
  EXPECT_LT(filtered.at<float>(20, 18), 0.1);
  EXPECT_GT(filtered.at<float>(20, 21), 0.5) << "filled up to the edge";
}

class Travelling : public testing::Test {
 protected:
  static constexpr int kSize = 48;

  /// Evidence of a square of 9 px at x that has moved by `off` standard deviations and `step` px.
  void see(int x, float off, float step) {
    FrameEvidence now{cv::Mat2f::zeros(kSize, kSize), cv::Mat2f::zeros(kSize, kSize)};
    const cv::Rect square(x, 20, 9, 9);
    now.normalized_residual(square).setTo(cv::Scalar(off, 0));
    now.back_step(square).setTo(cv::Scalar(-step, 0));
    evidence_.update(now, kStill, cv::Mat::zeros(kSize, kSize, CV_8U));
  }
  float motionAt(int x) const { return evidence_.motion().at<float>(24, x); }

  TravellingEvidence evidence_{ParallaxParameters{}};
};

TEST_F(Travelling, WhatMovesSteadilyAddsUpAndLeavesNoTrail) {
  for (int k = 0; k <= 20; ++k) see(4 + k, 8, 1);
  EXPECT_GT(motionAt(28), 0.7);
  EXPECT_LT(motionAt(15), 0.1) << "where it was ten frames ago";
}

TEST_F(Travelling, WhatMovesToAndFroDoesNot) {
  for (int k = 0; k <= 20; ++k) see(20 + k % 2, k % 2 == 0 ? -8.0F : 8.0F, k % 2 == 0 ? -1.0F : 1.0F);
  EXPECT_LT(motionAt(24), 0.3);
}

}  // namespace
}  // namespace redbee
