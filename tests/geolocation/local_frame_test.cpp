// Metres against GeographicLib's geodesics, with and without a fix.
#include "redbee/geolocation/local_frame.hpp"

#include <gtest/gtest.h>

#include <GeographicLib/Geodesic.hpp>
#include <cmath>

#include "redbee/geometry/angle.hpp"

namespace redbee::test {
namespace {

VehiclePose poseAt(std::optional<Geodetic> global, std::optional<Eigen::Vector3d> local, double time_s = 0) {
  VehiclePose pose;
  pose.time = ImuTime(fromSeconds(time_s));
  pose.R_EB.setIdentity();
  pose.global = global;
  pose.local = local;
  pose.position_covariance = 4 * Eigen::Matrix2d::Identity();
  return pose;
}

Geodetic moved(const Geodetic& from, double azimuth_deg, double distance_m) {
  Geodetic to;
  GeographicLib::Geodesic::WGS84().Direct(from.latitude_deg, from.longitude_deg, azimuth_deg, distance_m,
                                          to.latitude_deg, to.longitude_deg);
  return to;
}
double distanceOf(const Geodetic& a, const Geodetic& b) {
  double distance_m = 0;
  GeographicLib::Geodesic::WGS84().Inverse(a.latitude_deg, a.longitude_deg, b.latitude_deg, b.longitude_deg,
                                           distance_m);
  return distance_m;
}

TEST(LocalFrame, PlacesATargetWhereTheGeodesicEnds) {
  for (const Geodetic origin : {Geodetic{47.3, 8.5}, Geodetic{-33.9, 179.999}, Geodetic{69, -45}}) {
    LocalFrame frame;
    frame.placeOf(poseAt(origin, std::nullopt));
    // Ten kilometres out, a target 300 m north-east of the camera by the compass there.
    const Geodetic camera = moved(origin, 80, 10'000);
    const auto place = frame.placeOf(poseAt(camera, std::nullopt)).value();
    EXPECT_NEAR(place.position.norm(), 10'000, 0.1);
    const Eigen::Vector2d compass = 300 * Eigen::Vector2d(std::sin(0.7), std::cos(0.7));
    const Eigen::Vector2d offset = Eigen::Rotation2Dd(place.convergence) * compass;
    const Geodetic target = frame.geodeticOf(place.position + offset);
    EXPECT_LT((frame.positionOf(target) - place.position - offset).norm(), 0.01);
    EXPECT_NEAR(distanceOf(target, moved(camera, 0.7 / kDegree, 300)), 0, 0.02);
  }
}

TEST(LocalFrame, IsTheTakeOffsWithoutAFix) {
  LocalFrame frame;
  const auto place = frame.placeOf(poseAt(std::nullopt, Eigen::Vector3d(12, -5, 30)));
  ASSERT_TRUE(place);
  EXPECT_EQ(place->position, Eigen::Vector2d(12, -5));
  EXPECT_FALSE(frame.isGlobal());
  EXPECT_FALSE(frame.placeOf(poseAt(std::nullopt, std::nullopt)));
}

TEST(LocalFrame, KeepsPlacesWhenAFixComesAndGoes) {
  LocalFrame frame;
  frame.placeOf(poseAt(std::nullopt, Eigen::Vector3d(100, 200, 30)));
  const Geodetic camera{47.3, 8.5};
  const auto fixed = frame.placeOf(poseAt(camera, Eigen::Vector3d(100, 200, 30), 1)).value();
  EXPECT_FALSE(frame.takeRestart());
  EXPECT_NEAR((fixed.position - Eigen::Vector2d(100, 200)).norm(), 0, 0.01);
  EXPECT_NEAR(distanceOf(frame.geodeticOf({100, 200}), camera), 0, 0.01);
  const auto lost = frame.placeOf(poseAt(std::nullopt, Eigen::Vector3d(110, 200, 30), 11)).value();
  EXPECT_TRUE(frame.isGlobal());
  EXPECT_NEAR((lost.position - Eigen::Vector2d(110, 200)).norm(), 0, 0.01);
  EXPECT_GT(lost.covariance(0, 0), fixed.covariance(0, 0));
}

TEST(LocalFrame, SaysWhenEarlierPlacesMeanNothing) {
  LocalFrame frame;
  frame.placeOf(poseAt(std::nullopt, Eigen::Vector3d(100, 200, 30)));
  frame.placeOf(poseAt(Geodetic{47.3, 8.5}, std::nullopt, 1));  // nothing relates it to the frame before
  EXPECT_TRUE(frame.takeRestart());
  EXPECT_FALSE(frame.takeRestart());
}

}  // namespace
}  // namespace redbee::test
