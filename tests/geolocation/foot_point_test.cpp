// The foot: of boxes whose answer is plain, and of boxes around solids on the ground.
#include "redbee/geolocation/foot_point.hpp"

#include <gtest/gtest.h>

#include "redbee/geolocation/ground_point.hpp"
#include "tests/geolocation/simulated_watch.hpp"

namespace redbee::test {
namespace {

GroundView viewOf(double height_m, double depression_deg, double roll_deg) {
  GroundView view;
  view.R_EC = lookingNorth(depression_deg * kDegree, roll_deg * kDegree);
  view.position = {0, -height_m / std::tan(depression_deg * kDegree)};
  view.position_covariance.setZero();
  view.attitude_covariance.setZero();
  view.height_m = height_m;
  return view;
}

FootPoint footIn(const ImageBox& box, const GroundView& view, double height_over_length) {
  const auto camera = makeCameraModel(watchingCamera());
  return footOf(box, *camera, -view.R_EC.row(2).transpose(), height_over_length).value();
}

TEST(FootPoint, IsTheLowerMiddleOfWhatIsSeenFromTheSide) {
  const ImageBox box{600, 300, 80, 120};
  const FootPoint foot = footIn(box, viewOf(50, 1, 0), 1);
  EXPECT_NEAR(foot.pixel.x(), 639.5, 0.01);
  EXPECT_NEAR(foot.pixel.y(), 419.5, 2);  // the lower edge, but for one degree's 1.7 % of half the extent
  EXPECT_NEAR(foot.along_px, 120, 1e-3);
  EXPECT_NEAR(foot.across_px, 80, 1e-3);
}

TEST(FootPoint, FollowsGravityWhenTheCameraIsRolled) {
  const ImageBox box{600, 300, 80, 120};
  // Rolled by 90 degrees clockwise, the ground is at the image's right or left, not below.
  const FootPoint right = footIn(box, viewOf(50, 20, -90), 1e9);
  const FootPoint left = footIn(box, viewOf(50, 20, 90), 1e9);
  EXPECT_NEAR(std::abs(right.pixel.x() - left.pixel.x()), 80, 0.1);
  EXPECT_NEAR(right.pixel.y(), 359.5, 0.1);
  EXPECT_NEAR(left.pixel.y(), 359.5, 0.1);
}

TEST(FootPoint, IsTheMiddleOfWhatIsSeenFromAbove) {
  const ImageBox box{600, 300, 80, 120};
  const FootPoint foot = footIn(box, viewOf(50, 89.999, 0), 1);
  EXPECT_NEAR((foot.pixel - box.centre()).norm(), 0, 0.1);
}

/// The box of a cuboid's eight corners.
ImageBox boxAround(double length, double width, double height, const GroundView& view) {
  const auto camera = makeCameraModel(watchingCamera());
  Eigen::Vector2d low(1e9, 1e9), high(-1e9, -1e9);
  for (const double x : {-width / 2, width / 2}) {
    for (const double y : {-length / 2, length / 2}) {
      for (const double z : {0.0, height}) {
        const Eigen::Vector2d pixel = pixelOf(*camera, view, {x, y, z}).value();
        low = low.cwiseMin(pixel);
        high = high.cwiseMax(pixel);
      }
    }
  }
  return {std::round(low.x()), std::round(low.y()), std::round(high.x()) - std::round(low.x()) + 1,
          std::round(high.y()) - std::round(low.y()) + 1};
}

/// m, of the placed foot from the middle of the cuboid's place on the ground.
double missOf(double length, double width, double height, double k, double depression_deg, double roll_deg) {
  const GroundView view = viewOf(30, depression_deg, roll_deg);
  const ImageBox box = boxAround(length, width, height, view);
  const auto camera = makeCameraModel(watchingCamera());
  const auto point = groundPointOf(*camera, footIn(box, view, k).pixel, view, 0.01);
  return point.value().position.norm();
}

TEST(FootPoint, PlacesSolidsWithinAFractionOfTheirSize) {
  for (const double depression : {20.0, 40.0, 60.0, 80.0}) {
    EXPECT_LT(missOf(4, 1.8, 1.5, 0.4, depression, 0), 0.5) << "a car at " << depression;
    EXPECT_LT(missOf(0.5, 0.5, 1.75, 3.5, depression, 0), 0.35) << "a person at " << depression;
    // What the default says of both is off by less than half of the object, and by less than the box's
    // centre.
    EXPECT_LT(missOf(4, 1.8, 1.5, 1, depression, 0), 1.5) << "a car at " << depression;
    EXPECT_LT(missOf(0.5, 0.5, 1.75, 1, depression, 0), 0.9) << "a person at " << depression;
  }
}

}  // namespace
}  // namespace redbee::test
