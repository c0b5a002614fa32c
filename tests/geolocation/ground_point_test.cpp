// One ray: where it meets the ground, what is refused, and that the derivatives are those of the point.
#include "redbee/geolocation/ground_point.hpp"

#include <gtest/gtest.h>

#include "tests/geolocation/simulated_watch.hpp"

namespace redbee::test {
namespace {

constexpr double kLeast = 5 * kDegree;

GroundView viewFrom(double height_m, double depression_deg, double roll_deg = 0) {
  GroundView view;
  view.R_EC = lookingNorth(depression_deg * kDegree, roll_deg * kDegree);
  view.position = {3, -7};
  view.position_covariance.setZero();
  view.attitude_covariance.setZero();
  view.height_m = height_m;
  return view;
}

TEST(GroundPoint, IsWhereTheObjectStands) {
  const auto camera = makeCameraModel(watchingCamera());
  const GroundView view = viewFrom(40, 35, 20);
  for (const Eigen::Vector3d& place : {Eigen::Vector3d(0, 50, 0), {10, 60, 0}, {-15, 40, 0}}) {
    const auto pixel = pixelOf(*camera, view, place);
    ASSERT_TRUE(pixel);
    const auto point = groundPointOf(*camera, *pixel, view, kLeast);
    ASSERT_TRUE(point);
    EXPECT_NEAR((point->position - place.head<2>()).norm(), 0, 1e-9);
    EXPECT_NEAR(point->range_m, (place - Eigen::Vector3d(3, -7, 40)).norm(), 1e-9);
  }
}

TEST(GroundPoint, RefusesRaysAtAndAboveTheHorizon) {
  const auto camera = makeCameraModel(watchingCamera());
  const GroundView view = viewFrom(50, 10);
  const auto at = [&](double depression_deg) {
    const double v = 359.5 + 1000 * std::tan((depression_deg - 10) * kDegree);
    return groundPointOf(*camera, {639.5, v}, view, kLeast);
  };
  EXPECT_FALSE(at(-3));
  EXPECT_FALSE(at(0));
  EXPECT_FALSE(at(4.99));
  ASSERT_TRUE(at(5.01));
  EXPECT_NEAR(at(5.01)->depression, 5.01 * kDegree, 1e-9);
  GroundView below = view;
  below.height_m = -1;
  EXPECT_FALSE(groundPointOf(*camera, {639.5, 600}, below, kLeast));
}

TEST(GroundPoint, DerivativesAreThoseOfThePoint) {
  CameraIntrinsics intrinsics = watchingCamera();
  intrinsics.distortion = {-0.1, 0.02, 0.001, -0.002};
  const auto camera = makeCameraModel(intrinsics);
  const GroundView view = viewFrom(40, 30, 15);
  const Eigen::Vector2d pixel(900, 500);
  const auto point = groundPointOf(*camera, pixel, view, kLeast).value();
  const auto positionOf = [&](const CameraModel& model, const Eigen::Vector2d& at, const GroundView& from) {
    return groundPointOf(model, at, from, kLeast).value().position;
  };
  constexpr double kStep = 1e-5;
  for (int axis = 0; axis < 3; ++axis) {
    GroundView turned = view;
    turned.R_EC = expSO3(kStep * Eigen::Vector3d::Unit(axis)) * view.R_EC;
    const Eigen::Vector2d slope = (positionOf(*camera, pixel, turned) - point.position) / kStep;
    EXPECT_NEAR((slope - point.J_attitude.col(axis)).norm(), 0, 0.02) << axis;
  }
  GroundView higher = view;
  higher.height_m += kStep;
  EXPECT_NEAR(((positionOf(*camera, pixel, higher) - point.position) / kStep - point.J_height).norm(), 0,
              1e-6);
  for (int axis = 0; axis < 2; ++axis) {
    const Eigen::Vector2d step = 0.01 * Eigen::Vector2d::Unit(axis);
    const Eigen::Vector2d slope = (positionOf(*camera, pixel + step, view) - point.position) / 0.01;
    EXPECT_NEAR((slope - point.J_pixel.col(axis)).norm(), 0, 1e-4) << axis;
  }
  const auto plain = makeCameraModel(watchingCamera());
  CameraIntrinsics longer = watchingCamera();
  longer.fx *= 1 + kStep;
  longer.fy *= 1 + kStep;
  const auto at = groundPointOf(*plain, pixel, view, kLeast).value();
  const Eigen::Vector2d slope = (positionOf(*makeCameraModel(longer), pixel, view) - at.position) / kStep;
  // To first order in the angle off the axis, which a unit ray's change has in all three coordinates.
  EXPECT_NEAR((slope - at.J_focal).norm(), 0, 0.01 * at.J_focal.norm());
}

TEST(GroundPoint, FootprintHasEveryCornerOrIsNone) {
  const auto camera = makeCameraModel(watchingCamera());
  const auto footprint = footprintOf(watchingCamera(), *camera, viewFrom(40, 60), kLeast);
  ASSERT_TRUE(footprint);
  EXPECT_LT(footprint->col(0).x(), footprint->col(1).x());  // upper left is west of upper right
  EXPECT_GT(footprint->col(0).y(), footprint->col(3).y());  // and north of the lower left
  EXPECT_NEAR(footprint->col(0).y(), footprint->col(1).y(), 1e-9);
  EXPECT_FALSE(footprintOf(watchingCamera(), *camera, viewFrom(40, 15), kLeast));
}

}  // namespace
}  // namespace redbee::test
