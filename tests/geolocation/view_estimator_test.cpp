// The view at a frame's time from what came before and after it, and what is said where something is missing.
#include "redbee/geolocation/view_estimator.hpp"

#include <gtest/gtest.h>

#include "tests/geolocation/simulated_watch.hpp"

namespace redbee::test {
namespace {

ImuTime at(double time_s) { return ImuTime(fromSeconds(time_s)); }

/// Turns at 1 rad/s to the left, flies east at 10 m/s, climbs at 1 m/s.
VehiclePose turningPose(double time_s) {
  VehiclePose pose;
  pose.time = at(time_s);
  pose.R_EB = Eigen::AngleAxisd(time_s, Eigen::Vector3d::UnitZ());
  pose.velocity = Eigen::Vector3d(10, 0, 1);
  pose.local = Eigen::Vector3d(10 * time_s, 0, 20 + time_s);
  return pose;
}

/// The camera looks along the forward axis of body and mount.
ViewEstimator estimatorOf(const GeolocationParameters& parameters) {
  Eigen::Matrix3d R_CI;
  R_CI << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  return {parameters, R_CI, Eigen::Vector3d::Zero()};
}

TEST(ViewEstimator, InterpolatesAndCarriesOn) {
  ViewEstimator estimator = estimatorOf(watchParameters());
  for (const double t : {1.0, 1.1, 1.3}) estimator.note(turningPose(t));
  for (const double t : {1.05, 1.17, 1.3, 1.42}) {
    const ViewEstimate estimate = estimator.at(at(t));
    ASSERT_TRUE(estimate.view) << t;
    const Eigen::Vector3d axis = estimate.view->R_EC.col(2);
    EXPECT_NEAR((axis - Eigen::Vector3d(std::cos(t), std::sin(t), 0)).norm(), 0, 1e-9) << t;
    EXPECT_NEAR(estimate.view->position.x(), 10 * t, 1e-9);
    EXPECT_NEAR(estimate.view->height_m, 20 + t, 1e-9);
  }
}

TEST(ViewEstimator, SaysWhatIsMissing) {
  ViewEstimator estimator = estimatorOf(watchParameters());
  EXPECT_EQ(estimator.at(at(1)).fault, ViewFault::kNoPose);
  estimator.note(turningPose(1));
  EXPECT_EQ(estimator.at(at(1.19)).fault, ViewFault::kNone);
  EXPECT_EQ(estimator.at(at(1.21)).fault, ViewFault::kStalePose);
  EXPECT_NEAR(estimator.at(at(1.21)).age_s, 0.21, 1e-9);
  EXPECT_EQ(estimator.at(at(0.5)).fault, ViewFault::kStalePose);
  VehiclePose pose = turningPose(2);
  pose.local.reset();
  estimator.note(pose);
  EXPECT_EQ(estimator.at(at(2.1)).fault, ViewFault::kNone) << "the position of a second ago, interpolated";
  ViewEstimator nowhere = estimatorOf(watchParameters());
  nowhere.note(pose);
  EXPECT_EQ(nowhere.at(at(2)).fault, ViewFault::kNoPosition);
  pose.global = Geodetic{47, 8};
  ViewEstimator unknown_height = estimatorOf(watchParameters());
  unknown_height.note(pose);
  EXPECT_EQ(unknown_height.at(at(2)).fault, ViewFault::kNoHeight);
  unknown_height.note(HeightAboveGround{at(1.9), 25, 0.1});
  ASSERT_TRUE(unknown_height.at(at(2)).view);
  EXPECT_NEAR(unknown_height.at(at(2)).view->height_m, 25.1, 1e-9);  // climbing at 1 m/s
}

TEST(ViewEstimator, PrefersTheAltimeterWhileItIsFresh) {
  ViewEstimator estimator = estimatorOf(watchParameters());
  estimator.note(HeightAboveGround{at(1), 15, 0.1});
  for (const double t : {1.0, 1.4, 1.6}) estimator.note(turningPose(t));
  EXPECT_NEAR(estimator.at(at(1.4)).view->height_m, 15.4, 1e-9);
  EXPECT_NEAR(estimator.at(at(1.6)).view->height_m, 21.6, 1e-9);
}

TEST(ViewEstimator, TakesTheGimbalsAttitude) {
  GeolocationParameters parameters = watchParameters();
  parameters.mount = "gimbal";
  ViewEstimator estimator = estimatorOf(parameters);
  for (const double t : {1.0, 1.1}) estimator.note(turningPose(t));
  EXPECT_EQ(estimator.at(at(1.05)).fault, ViewFault::kNoMount);
  MountAttitude mount;
  mount.R_BM = Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitY());  // nose down
  for (const double t : {1.0, 1.1}) {
    mount.time = at(t);
    estimator.note(mount);
  }
  const Eigen::Vector3d by_body = estimator.at(at(1.05)).view->R_EC.col(2);
  EXPECT_NEAR((by_body - Eigen::AngleAxisd(1.05, Eigen::Vector3d::UnitZ()) *
                             Eigen::Vector3d(std::cos(0.5), 0, -std::sin(0.5)))
                  .norm(),
              0, 1e-9);
  mount.R_EM = Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitY());
  for (const double t : {1.12, 1.14}) {
    mount.time = at(t);
    estimator.note(mount);
  }
  const Eigen::Vector3d by_earth = estimator.at(at(1.13)).view->R_EC.col(2);
  EXPECT_NEAR((by_earth - Eigen::Vector3d(std::cos(0.7), 0, -std::sin(0.7))).norm(), 0, 1e-9);
}

}  // namespace
}  // namespace redbee::test
