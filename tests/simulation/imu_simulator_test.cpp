#include "redbee/simulation/imu_simulator.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <iostream>

#include "redbee/geometry/so3.hpp"

namespace redbee::simulation {
namespace {

ImuSimulatorParameters perfectImu() {
  ImuSimulatorParameters parameters;
  parameters.noise = {0, 0, 0, 0};
  return parameters;
}

Trajectory hover() {
  TrajectoryParameters parameters;
  parameters.position[2].offset = 5;
  return Trajectory(parameters);
}

/// Midpoint integration of the samples from the state at the first one.
TrajectoryState integrate(const std::vector<ImuSample>& samples, TrajectoryState state, double gravity) {
  for (size_t i = 0; i + 1 < samples.size(); ++i) {
    const double dt = seconds(samples[i + 1].time - samples[i].time);
    const Eigen::Matrix3d next_R = state.R_GI * expSO3((samples[i].gyro + samples[i + 1].gyro) / 2 * dt);
    const Eigen::Vector3d a = (state.R_GI * samples[i].accel + next_R * samples[i + 1].accel) / 2 -
                              gravity * Eigen::Vector3d::UnitZ();
    state.p_GI += state.v_GI * dt + a * dt * dt / 2;
    state.v_GI += a * dt;
    state.R_GI = next_R;
  }
  return state;
}

struct Statistics {
  double mean, deviation;
};

Statistics statisticsOf(const std::vector<double>& values) {
  double sum = 0, squares = 0;
  for (const double value : values) sum += value;
  const double mean = sum / static_cast<double>(values.size());
  for (const double value : values) squares += (value - mean) * (value - mean);
  return {mean, std::sqrt(squares / static_cast<double>(values.size()))};
}

TEST(ImuSimulator, APerfectImuIntegratesBackToTheTrajectory) {
  const Trajectory trajectory = Trajectory::calibration(5, 6);
  const std::vector<ImuSample> samples = simulateImu(trajectory, 0, 1, ImuTime(Duration(1000)), perfectImu());
  ASSERT_EQ(samples.size(), 401U);
  ASSERT_EQ(samples.back().time, ImuTime(Duration(1001000)));
  const TrajectoryState end = integrate(samples, trajectory.at(0), 9.81), truth = trajectory.at(1);
  const double angle_deg = logSO3(end.R_GI.transpose() * truth.R_GI).norm() * 180 / M_PI;
  std::cout << "after 1 s: " << (end.p_GI - truth.p_GI).norm() * 1e3 << " mm, " << angle_deg << " deg\n";
  EXPECT_LT((end.p_GI - truth.p_GI).norm(), 1e-3);
  EXPECT_LT((end.v_GI - truth.v_GI).norm(), 1e-3);
  EXPECT_LT(angle_deg, 2e-3);
}

TEST(ImuSimulator, AtRestItReadsGravityUpwards) {
  const ImuSample sample = simulateImu(hover(), 0, 0.01, ImuTime(), perfectImu()).front();
  EXPECT_LT((sample.accel - Eigen::Vector3d(0, 0, 9.81)).norm(), 1e-12);
  EXPECT_EQ(sample.gyro.norm(), 0);
}

TEST(ImuSimulator, NoiseHasTheDensityAskedFor) {
  ImuSimulatorParameters parameters = perfectImu();
  parameters.noise.gyro_noise_density = 2e-4;
  parameters.noise.accel_noise_density = 3e-3;
  parameters.gyro_bias = {0.01, 0, 0};
  std::vector<double> gyro, accel;
  for (const ImuSample& sample : simulateImu(hover(), 0, 100, ImuTime(), parameters)) {
    gyro.push_back(sample.gyro.x());
    accel.push_back(sample.accel.y());
  }
  const Statistics g = statisticsOf(gyro), a = statisticsOf(accel);
  EXPECT_NEAR(g.deviation, 2e-4 * 20, 0.02 * 2e-4 * 20);  // 40000 samples: 0.35 % of sampling error
  EXPECT_NEAR(a.deviation, 3e-3 * 20, 0.02 * 3e-3 * 20);
  EXPECT_NEAR(g.mean, 0.01, 5 * 2e-4 * 20 / std::sqrt(40001.0));
}

TEST(ImuSimulator, BiasesWalkAtTheRateAskedFor) {
  ImuSimulatorParameters parameters = perfectImu();
  parameters.rate_hz = 100;
  parameters.noise.gyro_random_walk = 1e-3;
  std::vector<double> ends;
  for (unsigned seed = 0; seed < 300; ++seed) {
    parameters.seed = seed;
    const Eigen::Vector3d end = simulateImu(hover(), 0, 4, ImuTime(), parameters).back().gyro;
    ends.insert(ends.end(), {end.x(), end.y(), end.z()});
  }
  // Deviation after t seconds is walk * sqrt(t); 900 draws know it to 2.4 %.
  EXPECT_NEAR(statisticsOf(ends).deviation, 1e-3 * std::sqrt(4.0), 4 * 0.024 * 2e-3);
}

TEST(ImuSimulator, TheAltimeterReadsTheCamerasHeight) {
  InertialExtrinsics extrinsics;
  extrinsics.p_IC = {0, 0, -0.5};
  const auto samples = simulateAltimeter(hover(), extrinsics, 0, 100, ImuTime(), 50, 0.05, 3);
  ASSERT_EQ(samples.size(), 5001U);
  std::vector<double> heights;
  heights.reserve(samples.size());
  for (const AltitudeSample& sample : samples) heights.push_back(sample.height_m);
  EXPECT_NEAR(statisticsOf(heights).mean, 4.5, 0.004);
  EXPECT_NEAR(statisticsOf(heights).deviation, 0.05, 0.003);
}

TEST(ImuSimulator, ExactMotionTakesGroundPointsFromCameraToCamera) {
  const Trajectory trajectory = Trajectory::ordinary(2, 6);
  InertialExtrinsics extrinsics;
  extrinsics.R_CI = expSO3({0.1, -0.4, 1.2});
  extrinsics.p_IC = {0.1, 0.2, -0.1};
  const PlaneMotion motion = exactMotion(trajectory, extrinsics, 1.0, 1.4);
  const TrajectoryState a = trajectory.at(1.0), b = trajectory.at(1.4);
  const Eigen::Vector3d ground(4, -2, 0);
  const Eigen::Vector3d X_a = extrinsics.R_CI * (a.R_GI.transpose() * (ground - a.p_GI) - extrinsics.p_IC);
  const Eigen::Vector3d X_b = extrinsics.R_CI * (b.R_GI.transpose() * (ground - b.p_GI) - extrinsics.p_IC);
  EXPECT_LT((motion.R_ba * X_a + motion.t_ba - X_b).norm(), 1e-12);
  EXPECT_NEAR(motion.m_a.dot(X_a), motion.h_a, 1e-12);
  EXPECT_GT(motion.h_a, 0);
}

}  // namespace
}  // namespace redbee::simulation
