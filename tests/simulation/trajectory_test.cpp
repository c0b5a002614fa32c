#include "redbee/simulation/trajectory.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "redbee/geometry/so3.hpp"

namespace redbee::simulation {
namespace {

constexpr double kStep = 1e-4;  // s

class BothTrajectories : public testing::TestWithParam<Trajectory (*)(unsigned, double)> {};

TEST_P(BothTrajectories, DerivativesAreThoseOfThePath) {
  const Trajectory trajectory = GetParam()(7, 6);
  for (double t = -1; t < 12; t += 0.37) {
    const TrajectoryState before = trajectory.at(t - kStep), state = trajectory.at(t),
                          after = trajectory.at(t + kStep);
    EXPECT_LT(((after.p_GI - before.p_GI) / (2 * kStep) - state.v_GI).norm(), 1e-6);
    EXPECT_LT(((after.v_GI - before.v_GI) / (2 * kStep) - state.a_GI).norm(), 1e-6);
    const Eigen::Vector3d rate = logSO3(before.R_GI.transpose() * after.R_GI) / (2 * kStep);
    EXPECT_LT((rate - state.omega_I).norm(), 1e-5);
    EXPECT_TRUE(isRotation(state.R_GI, 1e-12));
  }
}

TEST_P(BothTrajectories, TheSeedDecidesTheFlight) {
  const auto make = GetParam();
  EXPECT_EQ(make(3, 6).at(1.3).p_GI, make(3, 6).at(1.3).p_GI);
  EXPECT_GT((make(3, 6).at(1.3).p_GI - make(4, 6).at(1.3).p_GI).norm(), 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Trajectory, BothTrajectories,
                         testing::Values(&Trajectory::ordinary, &Trajectory::calibration));

TEST(Trajectory, OrdinaryFlightIsGentle) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const Trajectory trajectory = Trajectory::ordinary(seed, 6);
    for (double t = 0; t < 10; t += 0.1) {
      const TrajectoryState state = trajectory.at(t);
      EXPECT_LT(state.v_GI.norm(), 3.2);
      EXPECT_NEAR(state.p_GI.z(), 6, 0.1 * 6);
      EXPECT_LT(Eigen::AngleAxisd(state.R_GI).angle() * 180 / M_PI, 15);
    }
  }
}

TEST(Trajectory, CalibrationFlightTurnsAboutAllAxes) {
  const Trajectory trajectory = Trajectory::calibration(1, 6);
  Eigen::Vector3d highest = Eigen::Vector3d::Zero();
  for (double t = 0; t < 10; t += 0.05) highest = highest.cwiseMax(trajectory.at(t).omega_I.cwiseAbs());
  EXPECT_GT(highest.minCoeff(), 0.5) << "rad/s about the calmest axis";
}

}  // namespace
}  // namespace redbee::simulation
