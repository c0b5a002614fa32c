#include "redbee/inertial/mount_track.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "redbee/geometry/so3.hpp"
#include "tests/support/sampled_track.hpp"

namespace redbee::test {
namespace {

/// Turns at this rate about an axis of its own.
MountSample turned(double t_s, const Eigen::Vector3d& rate) {
  return {at(t_s), Eigen::Quaterniond(expSO3(rate * t_s))};
}

const Eigen::Vector3d kRate(0.3, -0.8, 0.5);

MountTrack track(const GimbalParameters& parameters = {}) {
  return sampledTrack<MountTrack>(parameters, [](double t_s) { return turned(t_s, kRate); });
}

TEST(MountTrack, ASteadyRotationIsInterpolatedExactly) {
  const MountTrack mounts = track();
  for (const double t_s : {0.0, 0.03, 0.1, 0.55, 1.0}) {
    const MountRotation mount = mounts.at(at(t_s));
    ASSERT_TRUE(mount.is_known) << t_s;
    EXPECT_TRUE(mount.R_MI.isApprox(expSO3(kRate * t_s).transpose(), 1e-9)) << t_s;
    EXPECT_TRUE(mount.rate_M.isApprox(kRate, 1e-6)) << t_s;
    EXPECT_GT(mount.variance, 0);
  }
}

TEST(MountTrack, NothingIsExtrapolated) {
  const MountTrack mounts = track();
  EXPECT_FALSE(mounts.at(at(-0.001)).is_known);
  EXPECT_FALSE(mounts.at(at(1.001)).is_known);
  EXPECT_TRUE(mounts.reaches(at(1)));
  EXPECT_FALSE(mounts.reaches(at(1.001)));
  EXPECT_FALSE(MountTrack({}).at(at(0)).is_known);
}

TEST(MountTrack, AGapIsNotBridged) {
  MountTrack mounts = track();
  mounts.add(turned(1.3, kRate));
  EXPECT_FALSE(mounts.at(at(1.1)).is_known);
  EXPECT_TRUE(mounts.at(at(1.3)).is_known) << "at the message's own time";
  EXPECT_TRUE(mounts.at(at(1.0)).is_known);
}

TEST(MountTrack, TheOrderDoesNotCount) {
  MountTrack mounts({});
  for (const int i : {3, 0, 2, 1, 2}) mounts.add(turned(0.1 * i, kRate));
  EXPECT_TRUE(mounts.at(at(0.15)).R_MI.isApprox(expSO3(kRate * 0.15).transpose(), 1e-9));
}

TEST(MountTrack, AQuaternionAndItsNegativeAreOneRotation) {
  MountTrack mounts({});
  mounts.add(turned(0, kRate));
  MountSample negative = turned(0.1, kRate);
  negative.q_IM.coeffs() *= -1;
  mounts.add(negative);
  EXPECT_TRUE(mounts.at(at(0.05)).R_MI.isApprox(expSO3(kRate * 0.05).transpose(), 1e-9));
  EXPECT_TRUE(mounts.at(at(0.05)).rate_M.isApprox(kRate, 1e-6));
}

TEST(MountTrack, TheTimeShiftIsTakenOut) {
  GimbalParameters late;
  late.timeshift_s = -0.05;  // it says where it was 50 ms ago
  const MountTrack mounts = track(late);
  EXPECT_TRUE(mounts.at(at(0.4)).R_MI.isApprox(expSO3(kRate * 0.45).transpose(), 1e-9));
  EXPECT_FALSE(mounts.reaches(at(0.96)));
}

TEST(MountTrack, AClockThatWasSetBackBeginsAgain) {
  MountTrack mounts = track();
  for (int i = 0; i < 3; ++i) mounts.add({at(-10 + 0.1 * i), Eigen::Quaterniond::Identity()});
  EXPECT_FALSE(mounts.at(at(0.5)).is_known);
  EXPECT_TRUE(mounts.at(at(-9.9)).is_known);
}

TEST(MountTrack, WhatIsNoRotationIsRefused) {
  MountTrack mounts({});
  EXPECT_FALSE(mounts.add({at(0), Eigen::Quaterniond(0, 0, 0, 0)}));
  EXPECT_FALSE(mounts.add({at(0), Eigen::Quaterniond(NAN, 0, 0, 1)}));
  EXPECT_FALSE(mounts.add({ImuTime(kMaxTime), Eigen::Quaterniond::Identity()}));
  EXPECT_FALSE(mounts.reaches(at(-1)));
}

TEST(MountTrack, WhatIsErasedIsStillAnEndOfItsInterval) {
  MountTrack mounts = track();
  mounts.eraseBefore(at(0.55));
  EXPECT_TRUE(mounts.at(at(0.55)).is_known);
  EXPECT_FALSE(mounts.at(at(0.45)).is_known);
}

}  // namespace
}  // namespace redbee::test
