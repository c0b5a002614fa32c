#include "redbee/detection/parallax/parallax_segment.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <optional>

#include "redbee/geometry/so3.hpp"

namespace redbee {
namespace {

const Symmetric2f kNoise(0.25F, 0, 0.25F);

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
                  {static_cast<float>(flow.x()), static_cast<float>(flow.y())}, kNoise);
  }

  Eigen::Matrix3d K_;
  PlaneMotion motion_;
};

TEST_F(Parallax, StaticPointsAtAnyDepthBeforeTheGroundAreExplained) {
  for (const double fraction : {0.3, 0.5, 0.8, 1.0}) {
    const Eigen::Vector3d ray = K_.inverse() * Eigen::Vector3d(150, 300, 1);
    const Eigen::Vector3d X = fraction * motion_.h_a / motion_.m_a.dot(ray) * ray;
    const Eigen::Vector2d now = project(motion_.R_ba * X + motion_.t_ba);
    EXPECT_LT(residual({150, 300}, now).squaredMahalanobis(), 0.01)
        << "at " << fraction << " of the way to the ground";
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

TEST(ParallaxSegmentNoise, FlowAlongAnEdgeIsNoEvidence) {
  // Without parallax the residual is the flow, over its sigmas of 0.5 px across the edge and 5 px along it.
  const ParallaxSegment none(std::nullopt, Eigen::Matrix3d::Identity(), {});
  const Symmetric2f vertical_edge(0.25F, 0, 25);
  EXPECT_NEAR(none.residual({100, 100}, {2, 0}, vertical_edge).squaredMahalanobis(), 16, 1e-4);
  EXPECT_NEAR(none.residual({100, 100}, {0, 2}, vertical_edge).squaredMahalanobis(), 0.16, 1e-4);
  // The same edge turned by 45 degrees.
  const Symmetric2f turned(12.625F, 12.375F, 12.625F);
  const float half = std::sqrt(2.0F);
  EXPECT_NEAR(none.residual({100, 100}, {half, -half}, turned).squaredMahalanobis(), 16, 1e-3);
  EXPECT_NEAR(none.residual({100, 100}, {half, half}, turned).squaredMahalanobis(), 0.16, 1e-4);
}

TEST(ParallaxSegmentNoise, TheNearestPointIsByMahalanobisDistance) {
  // Parallax along x; the flow slides along an edge at 45 degrees, from a point on the segment.
  ParallaxParameters parameters;
  parameters.direction_error = 0;
  const ParallaxSegment segment(cv::Vec3f(20, 0, 0), parameters);
  const float slid = 3;
  const auto residual = segment.residual({100, 100}, {5 + slid, slid}, {12.625F, 12.375F, 12.625F});
  EXPECT_NEAR(residual.nearest[0], 5, 0.2);
  EXPECT_NEAR(residual.nearest[1], 0, 1e-4);
  EXPECT_LT(residual.squaredMahalanobis(), 1);
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
                  {static_cast<float>(flow.x()), static_cast<float>(flow.y())}, kNoise)
        .squaredMahalanobis();
  };
  const Eigen::Vector2d parallax = transfer(planeHomography(K_, facade), before) - on_ground;
  const Eigen::Vector2d across = Eigen::Vector2d(-parallax.y(), parallax.x()).normalized();
  EXPECT_LT(sigmas(5, {0, 0}), 0.01) << "on the facade";
  EXPECT_LT(sigmas(6, {0, 0}), 0.1) << "behind it";
  EXPECT_GT(sigmas(5, 4 * across), 10) << "moves";
}

}  // namespace
}  // namespace redbee
