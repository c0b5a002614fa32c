// The parts that the calibration starts from: IMU history, preintegration, rotations, closed form, target
// pose.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <iostream>

#include "redbee/calibration/initial_trajectory.hpp"
#include "redbee/calibration/rotation_alignment.hpp"
#include "redbee/calibration/target_pose.hpp"
#include "tests/support/calibration_recording.hpp"

namespace redbee::calibration {
namespace {

using simulation::Trajectory;
using test::RecordingOptions;
using test::SimulatedRecording;
using test::simulateRecording;

RecordingOptions briefly(double duration_s) {
  RecordingOptions options;
  options.duration_s = duration_s;
  return options;
}

std::vector<ImuSample> perfectImu(const Trajectory& trajectory, double end_s) {
  simulation::ImuSimulatorParameters parameters;
  parameters.noise = {0, 0, 0, 0};
  return simulation::simulateImu(trajectory, 0, end_s, ImuTime(), parameters);
}

TEST(ImuHistory, RotationBetweenAnyTimesIsTheTrajectorys) {
  const Trajectory trajectory = Trajectory::calibration(3, 6);
  const ImuHistory imu(perfectImu(trajectory, 3), ImuTime());
  const double a = 0.50123, b = 2.00071;
  const Eigen::Matrix3d expected = trajectory.at(a).R_GI.transpose() * trajectory.at(b).R_GI;
  EXPECT_LT(logSO3(imu.rotation(a, b) * expected.transpose()).norm(), 2e-5);
}

TEST(ImuHistory, SortsLateSamplesAndReportsGaps) {
  std::vector<ImuSample> samples = perfectImu(Trajectory::calibration(1, 6), 2);
  std::swap(samples[10], samples[20]);
  samples[30].gyro.x() = std::nan("");
  const ImuHistory whole(samples, ImuTime());
  EXPECT_EQ(whole.size(), samples.size() - 1);
  EXPECT_TRUE(whole.covers(0.1, 1.9, 0.01));
  samples.erase(samples.begin() + 400, samples.begin() + 480);
  EXPECT_FALSE(ImuHistory(samples, ImuTime()).covers(0.1, 1.9, 0.1));
  EXPECT_FALSE(whole.covers(0.1, 2.5, 0.1));
}

TEST(Preintegration, CarriesTheStateFromOneTimeToTheOther) {
  const Trajectory trajectory = Trajectory::calibration(2, 6);
  const ImuHistory imu(perfectImu(trajectory, 2), ImuTime());
  const auto a = trajectory.at(0.7011), b = trajectory.at(1.2043);
  const Preintegration sum = preintegrate(imu, 0.7011, 1.2043, {}, {});
  const Eigen::Vector3d g(0, 0, -9.81);
  EXPECT_LT(logSO3(a.R_GI * sum.R * b.R_GI.transpose()).norm(), 2e-5);
  EXPECT_LT((a.v_GI + g * sum.dt_s + a.R_GI * sum.v - b.v_GI).norm(), 1e-3);
  EXPECT_LT((a.p_GI + a.v_GI * sum.dt_s + 0.5 * sum.dt_s * sum.dt_s * g + a.R_GI * sum.p - b.p_GI).norm(),
            5e-4);
}

TEST(Preintegration, FirstOrderBiasCorrectionReplacesIntegratingAgain) {
  const ImuHistory imu(perfectImu(Trajectory::calibration(2, 6), 2), ImuTime());
  const Bias bias{{0.003, -0.002, 0.004}, {0.03, -0.02, 0.05}};
  const Preintegration without = preintegrate(imu, 0.5, 0.75, {}, {});
  const Preintegration with = preintegrate(imu, 0.5, 0.75, bias, {});
  EXPECT_LT(logSO3(with.R.transpose() * without.R * expSO3(without.R_by_gyro * bias.gyro)).norm(), 1e-6);
  EXPECT_LT((with.v - without.v - without.v_by_gyro * bias.gyro - without.v_by_accel * bias.accel).norm(),
            1e-5);
  EXPECT_LT((with.p - without.p - without.p_by_gyro * bias.gyro - without.p_by_accel * bias.accel).norm(),
            1e-6);
}

TEST(HomographyRotation, OneCandidateIsTheTrueRotation) {
  const SimulatedRecording r = simulateRecording(Trajectory::calibration(1, 6), 1, briefly(1));
  const Eigen::Matrix3d K = Camera(r.input.camera).K();
  const PlaneMotion motion = simulation::exactMotion(Trajectory::calibration(1, 6), r.truth, 0.4, 0.6);
  const RotationCandidates found = rotationsFromHomography(K, planeHomography(K, motion));
  double best = 1;
  for (const Eigen::Vector3d& candidate : found.exact)
    best = std::min(best, (candidate + logSO3(motion.R_ba)).norm());
  EXPECT_LT(best, 1e-6);
}

TEST(HandEye, FindsRotationAndBiasAmongOutliers) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const Eigen::Matrix3d R_CI = expSO3({1.1, -0.7, 0.4});
  const Eigen::Vector3d bias(0.01, -0.02, 0.005);
  std::vector<RatePair> pairs;
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector3d rate(uniform(random), uniform(random), 0.5 * uniform(random));
    const Eigen::Vector3d wrong =
        i % 5 == 0 ? Eigen::Vector3d(uniform(random), 1, 1) : Eigen::Vector3d::Zero();
    pairs.push_back({R_CI * rate + wrong, rate + bias});
  }
  const HandEye solution = solveHandEye(pairs);
  EXPECT_LT(logSO3(solution.R_CI * R_CI.transpose()).norm(), 1e-3);
  EXPECT_LT((solution.gyro_bias - bias).norm(), 1e-3);
}

TEST(HandEye, TurningAboutOneAxisLeavesTheSecondSingularValueAtZero) {
  std::vector<RatePair> pairs;
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d rate = std::sin(0.3 * i) * Eigen::Vector3d(0.1, 0.9, -0.2);
    pairs.push_back({expSO3({0.5, 0.2, 0.1}) * rate, rate});
  }
  const HandEye solution = solveHandEye(pairs);
  EXPECT_GT(solution.excitation(0), 0.3);
  EXPECT_LT(solution.excitation(1), 1e-6);
}

TEST(RotationAlignment, FindsTimeShiftAndRotationWithoutAStartingValue) {
  SimulatedRecording r = simulateRecording(Trajectory::calibration(7, 6), 7, briefly(8));
  const ImuHistory imu(r.input.imu, toImu(r.input.frames.front(), Duration(0)));
  std::vector<RotationObservation> observations;
  const Camera camera(r.input.camera);
  for (const GroundMatch& match : r.input.ground) {
    const auto estimate = estimateHomography(match.points, 640, 480, r.input.ransac);
    ASSERT_TRUE(estimate);
    const auto time_s = [&](CameraTime frame) { return seconds(frame - r.input.frames.front()); };
    observations.push_back(
        {time_s(match.time_a), time_s(match.time_b), rotationsFromHomography(camera.K(), estimate->H)});
  }
  const RotationAlignment alignment = alignRotations(observations, imu);
  ASSERT_TRUE(alignment.possible);
  const double error_deg = logSO3(alignment.hand_eye.R_CI * r.truth.R_CI.transpose()).norm() / kDegree;
  std::cout << "closed form: rotation off by " << error_deg << " deg, time shift by "
            << 1e3 * (alignment.timeshift_s - r.truth.timeshift_s) << " ms\n";
  EXPECT_LT(error_deg, 0.2);
  EXPECT_NEAR(alignment.timeshift_s, r.truth.timeshift_s, 1e-3);
}

TargetView viewOfGrid(const Camera& camera, const Eigen::Matrix3d& R_CT, const Eigen::Vector3d& p_CT) {
  TargetView view;
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 6; ++column) {
      view.corners.emplace_back(0.1 * column, 0.1 * row, 0);
      const Eigen::Vector3d X = R_CT * view.corners.back() + p_CT;
      view.pixels.push_back(*camera.distort((camera.K() * X).hnormalized()));
    }
  }
  return view;
}

TEST(TargetPose, IsFoundThroughDistortionAndRefusedWhenCornersAreWrong) {
  const Camera camera({752, 480, 458.6, 457.3, 367.2, 248.4, {-0.283, 0.074, 0.0002, 0.00002, 0}});
  const Eigen::Matrix3d R_CT = expSO3({0.3, -0.2, 0.8});
  const Eigen::Vector3d p_CT(-0.2, -0.1, 1.2);
  TargetView view = viewOfGrid(camera, R_CT, p_CT);
  const auto pose = estimateTargetPose(camera, view);
  ASSERT_TRUE(pose);
  EXPECT_LT(logSO3(pose->q_CT.toRotationMatrix() * R_CT.transpose()).norm(), 1e-6);
  EXPECT_LT((pose->p_CT - p_CT).norm(), 1e-6);
  std::mt19937 random(1);
  std::shuffle(view.pixels.begin(), view.pixels.end(), random);
  EXPECT_FALSE(estimateTargetPose(camera, view));
  view.pixels.resize(5);
  view.corners.resize(5);
  EXPECT_FALSE(estimateTargetPose(camera, view));
}

}  // namespace
}  // namespace redbee::calibration
