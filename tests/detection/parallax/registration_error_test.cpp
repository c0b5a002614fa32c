#include "redbee/detection/parallax/registration_error.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace redbee {
namespace {

const cv::Size kSize(320, 240);
const cv::Mat kAllKnown = cv::Mat::zeros(kSize, CV_8U);
const FlowCovariance kVariance(kSize, 0.06F);
constexpr float kExpected_px = 0.25F;

const Eigen::Matrix3d kCamera = (Eigen::Matrix3d() << 250, 0, 159.5, 0, 250, 119.5, 0, 0, 1).finished();

HomographyFlow drift() {
  HomographyFlow flow(kSize);
  flow.affine << 0.16F, -0.08F, 0.3F, 0.13F, 0.1F, -0.1F;
  flow.perspective = {0.2F, -0.15F};
  return flow;
}

/// Flow back to the earlier image where the registration is off by `error` and `parallax` stands above the
/// ground.
template <typename Parallax>
cv::Mat flowOf(const HomographyFlow& error, const Parallax& parallax) {
  cv::Mat flow(kSize, CV_32FC2);
  for (int y = 0; y < kSize.height; ++y) {
    for (int x = 0; x < kSize.width; ++x) {
      const auto u = static_cast<float>(x), v = static_cast<float>(y);
      flow.at<cv::Vec2f>(y, x) = -(error.at(u, v) + parallax(x, y));
    }
  }
  return flow;
}

/// Greatest difference over the image, of one component.
float worst(const HomographyFlow& found, const HomographyFlow& truth, int component) {
  float difference = 0;
  for (const float x : {0.0F, 319.0F}) {
    for (const float y : {0.0F, 239.0F}) {
      difference = std::max(difference, std::abs(found.at(x, y)[component] - truth.at(x, y)[component]));
    }
  }
  return difference;
}

TEST(HomographyFlow, IsAHomographysToFirstOrder) {
  // x ~ H x with H near the identity, in the units of the flow.
  Eigen::Matrix3f H = Eigen::Matrix3f::Identity();
  constexpr float kUnit_px = 160;
  H.topRows<2>() += drift().affine / kUnit_px;
  H.row(2).head<2>() = -Eigen::RowVector2f(drift().perspective[0], drift().perspective[1]) / kUnit_px;
  for (const cv::Point2f& p : {cv::Point2f(20, 30), cv::Point2f(300, 50), cv::Point2f(150, 220)}) {
    const Eigen::Vector3f before((p.x - 160) / kUnit_px, (p.y - 120) / kUnit_px, 1);
    const Eigen::Vector2f moved = kUnit_px * ((H * before).hnormalized() - before.head<2>());
    const cv::Vec2f flow = drift().at(p.x, p.y);
    EXPECT_NEAR(flow[0], moved.x(), 0.005);
    EXPECT_NEAR(flow[1], moved.y(), 0.005);
  }
}

TEST(RegistrationError, WithoutParallaxAllOfItIsFound) {
  const ParallaxSegment none(std::nullopt, kCamera, ParallaxParameters{});
  const cv::Mat flow = flowOf(drift(), [](int, int) { return cv::Vec2f(0, 0); });
  const HomographyFlow found = registrationError(flow, kVariance, kAllKnown, none, kExpected_px);
  EXPECT_LT(worst(found, drift(), 0), 0.02F);
  EXPECT_LT(worst(found, drift(), 1), 0.02F);
}

TEST(RegistrationError, AMoverOnAFifthOfTheImageDoesNotBiasIt) {
  const ParallaxSegment none(std::nullopt, kCamera, ParallaxParameters{});
  const cv::Mat flow =
      flowOf(drift(), [](int x, int y) { return x < 140 && y > 120 ? cv::Vec2f(3, -2) : cv::Vec2f(0, 0); });
  const HomographyFlow found = registrationError(flow, kVariance, kAllKnown, none, kExpected_px);
  EXPECT_LT(worst(found, drift(), 0), 0.05F);
  EXPECT_LT(worst(found, drift(), 1), 0.05F);
}

TEST(RegistrationError, SidewaysFlightShowsTheErrorAcrossAtAnyDepth) {
  // Level flight to the right: parallax is horizontal, and of any size here.
  const PlaneMotion sideways{Eigen::Matrix3d::Identity(), {-0.1, 0, 0}, {0, 1, 0}, 8.0};
  const ParallaxSegment segment(sideways, kCamera, ParallaxParameters{});
  const cv::Mat flow = flowOf(
      drift(), [](int x, int y) { return cv::Vec2f(-0.02F * static_cast<float>((7 * x + y) % 100), 0); });
  const HomographyFlow found = registrationError(flow, kVariance, kAllKnown, segment, kExpected_px);
  EXPECT_LT(worst(found, drift(), 1), 0.05F);
  HomographyFlow across = drift();
  across.affine.row(0).setZero();
  EXPECT_LT(worst(found, across, 0), 0.05F) << "along the parallax only the perspective is observable";
}

TEST(RegistrationError, AnUnknownImageHasNone) {
  const ParallaxSegment none(std::nullopt, kCamera, ParallaxParameters{});
  const cv::Mat flow(kSize, CV_32FC2, cv::Scalar(4, 4));
  const cv::Mat unknown(kSize, CV_8U, cv::Scalar(255));
  const HomographyFlow found = registrationError(flow, kVariance, unknown, none, kExpected_px);
  EXPECT_TRUE(found.affine.isZero());
  EXPECT_EQ(found.perspective, cv::Vec2f(0, 0));
}

}  // namespace
}  // namespace redbee
