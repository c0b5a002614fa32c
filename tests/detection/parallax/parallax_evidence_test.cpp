#include "redbee/detection/parallax/parallax_evidence.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <optional>

namespace redbee {
namespace {

const Eigen::Matrix3d kStill = Eigen::Matrix3d::Identity();

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
  cv::Mat then = ground.clone(), now = ground.clone();
  paint.copyTo(then(cv::Rect(70, 75, 10, 10)));
  paint.copyTo(now(cv::Rect(73, 75, 10, 10)));
  ParallaxParameters parameters;
  parameters.work_downscale = work_downscale;
  parameters.flow_downscale = flow_downscale;
  InverseSearch search = makeMotionFlow(parameters);
  const cv::Mat2f& flow = search.flow(now, then);
  EXPECT_EQ(flow.size(), now.size());
  return flow(80, 78);
}

TEST(MotionFlow, AFinerOneSeesAMoverThatAPatchOfACoarserOneHides) {
  EXPECT_LT(cv::norm(flowOfSmallMover(1, 1) - cv::Vec2f(-3, 0)), 0.5);
  EXPECT_GT(cv::norm(flowOfSmallMover(1, 4) - cv::Vec2f(-3, 0)), 1.5);
}

TEST(MotionFlow, NoFinerThanTheImageThatItIsFor) {
  EXPECT_EQ(flowOfSmallMover(2, 1), flowOfSmallMover(2, 2));
  EXPECT_EQ(flowOfSmallMover(4, 1), flowOfSmallMover(4, 2));
}

/// The photometric gain after two frames; empty if it is not known.
cv::Mat1f gainOfTwoFrames(const std::optional<PlaneMotion>& motion) {
  cv::Mat1b texture(120, 160);
  cv::RNG(3).fill(texture, cv::RNG::UNIFORM, 0, 255);
  Eigen::Matrix3d K = kStill;
  K(0, 0) = K(1, 1) = 300;
  K(0, 2) = 160;
  K(1, 2) = 120;
  ParallaxParameters parameters;
  parameters.border_stretch = 0;
  ParallaxEvidence evidence(parameters);
  SpareMaps spare;
  evidence.learn(CameraTime(Duration(1'000'000)), texture, K, {320, 240}, {}, spare);
  evidence.propagate(kStill, std::nullopt, motion);
  evidence.learn(CameraTime(Duration(1'083'000)), texture, K, {320, 240}, {}, spare);
  return evidence.photometricGain(cv::Mat1f(240, 320, 1));
}

TEST(ParallaxEvidence, TheGainIsKnownWithTheDirectionOfTravel) {
  const PlaneMotion motion{kStill, {0.1, 0, 0}, {0, 0, 1}, 5};
  EXPECT_EQ(gainOfTwoFrames(motion).size(), cv::Size(160, 120));
  EXPECT_TRUE(gainOfTwoFrames(std::nullopt).empty()) << "static surfaces may be anywhere";
}

}  // namespace
}  // namespace redbee
