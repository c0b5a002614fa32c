#include "redbee/detection/parallax/epipole.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace redbee {
namespace {

const cv::Size kSize(320, 240);
const cv::Matx33d kCamera(250, 0, 159.5, 0, 250, 119.5, 0, 0, 1);
const cv::Vec3d kTravel(0.03, 0.01, 0.02);                   // in heights above the ground
const cv::Vec3d kNormal(0, std::sqrt(0.5), std::sqrt(0.5));  // the camera looks 45 degrees down
constexpr double kFrame_s = 1.0 / 24;
constexpr float kNoise_px = 0.1F;

/// Parallax of kTravel at depth 1.
cv::Vec3f trueEpipole() { return 5 * kCamera * kTravel; }

cv::Vec2f parallax(const cv::Vec3f& e, const cv::Vec2f& ground) {
  return {e[0] - e[2] * ground[0], e[1] - e[2] * ground[1]};
}

/// The ground without residual flow.
EpipoleInput emptyGround() {
  EpipoleInput input{cv::Mat2f(kSize),
                     FlowCovariance(kSize, kNoise_px * kNoise_px),
                     cv::Mat1b::zeros(kSize),
                     HomographyFlow(kSize),
                     kCamera * (cv::Matx33d::eye() + kTravel * kNormal.t()) * kCamera.inv(),
                     kCamera,
                     kCamera};
  cv::RNG random(7);
  random.fill(input.flow, cv::RNG::NORMAL, 0, kNoise_px);
  return input;
}

/// A surface at `depth` along the parallax of `e`, above the pixels of `where`.
void raise(EpipoleInput& input, const cv::Rect& where, const cv::Vec3f& e, float depth) {
  for (int y = where.y; y < where.br().y; ++y) {
    for (int x = where.x; x < where.br().x; ++x) {
      const cv::Vec2f pixel(static_cast<float>(x), static_cast<float>(y));
      const cv::Vec2f ground = (pixel - depth * cv::Vec2f(e[0], e[1])) * (1 / (1 - depth * e[2]));
      input.flow(y, x) += ground - pixel;
    }
  }
}

/// Posts all over the image, at depths from 0.2 to 0.6.
EpipoleInput posts(const cv::Vec3f& e) {
  EpipoleInput input = emptyGround();
  for (int i = 0; i < 24; ++i) {
    const cv::Rect post(10 + 52 * (i % 6), 8 + 58 * (i / 6), 20, 45);
    raise(input, post, e, 0.2F + 0.1F * static_cast<float>(i % 5));
  }
  return input;
}

TEST(EpipoleEstimator, FindsTheEpipoleOfStaticSurfacesAtAnyDepth) {
  const cv::Vec3f truth = trueEpipole();
  const auto found = EpipoleEstimator().update(posts(truth), kFrame_s);
  ASSERT_TRUE(found);
  for (const cv::Vec2f& place :
       {cv::Vec2f(20, 20), cv::Vec2f(300, 30), cv::Vec2f(160, 120), cv::Vec2f(20, 220)}) {
    const cv::Vec2f is = parallax(*found, place), was = parallax(truth, place);
    const float angle = std::atan2(is[0] * was[1] - is[1] * was[0], is.dot(was));
    EXPECT_NEAR(angle, 0, 0.03) << place;
    EXPECT_GT(cv::norm(is), 0.6 * cv::norm(was)) << "the nearest post is beyond the segment at " << place;
  }
}

TEST(EpipoleEstimator, ToleratesAGuessedFocalLength) {
  EpipoleInput input = posts(trueEpipole());
  input.K(0, 0) = input.K(1, 1) = 1.3 * kCamera(0, 0);
  input.K_earlier = input.K;
  EXPECT_TRUE(EpipoleEstimator().update(input, kFrame_s));
}

/// What a lens does that zooms in is no travel along the optical axis.
TEST(EpipoleEstimator, HeedsALensThatZooms) {
  EpipoleInput input = posts(trueEpipole());
  cv::Matx33d zoomed = kCamera;
  zoomed(0, 0) = zoomed(1, 1) = 0.9 * kCamera(0, 0);
  input.ground = input.ground * kCamera * zoomed.inv();
  EXPECT_FALSE(EpipoleEstimator().update(input, kFrame_s));
  input.K_earlier = zoomed;
  EXPECT_TRUE(EpipoleEstimator().update(input, kFrame_s));
}

TEST(EpipoleEstimator, HasNoneWithoutParallax) {
  EXPECT_FALSE(EpipoleEstimator().update(emptyGround(), kFrame_s));
}

TEST(EpipoleEstimator, RefusesOneAcrossTheDirectionOfTravel) {
  // Objects that all move to one point.
  const cv::Vec3d across(kTravel[1], -kTravel[0], 0);
  EXPECT_FALSE(EpipoleEstimator().update(posts(5 * kCamera * across), kFrame_s));
}

TEST(EpipoleEstimator, RefusesOneInTheDirectionOfTravelThatASinglePlaceAgreesOn) {
  EpipoleInput input = emptyGround();
  raise(input, {100, 80, 70, 60}, trueEpipole(), 0.4F);
  EXPECT_FALSE(EpipoleEstimator().update(input, kFrame_s));
}

TEST(EpipoleEstimator, RefusesOneThatMostOfTheMotionDoesNotAgreeWith) {
  EpipoleInput input = posts(trueEpipole());
  cv::RNG random(3);
  for (int i = 0; i < 24; ++i) {
    const cv::Rect object(10 + 52 * (i % 6), 8 + 58 * (i / 6), 50, 50);
    const cv::Vec2f shift(random.uniform(-6.F, 6.F), random.uniform(-6.F, 6.F));
    if (i % 4 != 0) input.flow(object & cv::Rect({}, kSize)).setTo(cv::Scalar(shift[0], shift[1]));
  }
  EXPECT_FALSE(EpipoleEstimator().update(input, kFrame_s));
}

TEST(EpipoleEstimator, NeedsItsSupportOverTime) {
  EpipoleEstimator estimator;
  const EpipoleInput parallax_everywhere = posts(trueEpipole());
  for (int i = 0; i < 48; ++i) estimator.update(emptyGround(), kFrame_s);
  EXPECT_FALSE(estimator.update(parallax_everywhere, kFrame_s));
  for (int i = 0; i < 24; ++i) estimator.update(parallax_everywhere, kFrame_s);
  EXPECT_TRUE(estimator.update(parallax_everywhere, kFrame_s));
  EXPECT_FALSE(estimator.update(emptyGround(), kFrame_s));
  estimator.reset();
  EXPECT_TRUE(estimator.update(parallax_everywhere, kFrame_s));
}

}  // namespace
}  // namespace redbee
