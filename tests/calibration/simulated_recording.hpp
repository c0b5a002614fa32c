// Calibration inputs with a known truth, without images: ground points moved by the exact homographies of
// an analytic flight.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

#include "redbee/calibration/calibration.hpp"
#include "redbee/geometry/angle.hpp"
#include "redbee/geometry/so3.hpp"
#include "redbee/simulation/imu_simulator.hpp"
#include "redbee/simulation/scenarios.hpp"
#include "redbee/simulation/trajectory.hpp"

namespace redbee::calibration {

struct SimulatedRecording {
  CalibrationInput input;
  InertialExtrinsics truth;
  Eigen::Vector3d gyro_bias;
  Eigen::Vector3d accel_bias;
};

struct SimulationChoices {
  double duration_s = 12;
  double fps = 24;
  double noise_px = 0.15;  ///< per axis, white
  double common_noise_px =
      0;                     ///< per axis, shared by all points of a quarter of the image: correlated errors
  double outlier_ratio = 0;  ///< of the points
  bool altimeter = false;
  double height_m = 6;
  int grid_px = 32;
};

inline Eigen::Vector3d randomDirection(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
}

class PointNoise {
 public:
  PointNoise(const SimulationChoices& choices, unsigned seed) : choices_(choices), random_(seed) {}

  void beginPair() {
    for (auto& shift : common_) shift = vector(choices_.common_noise_px);
  }
  cv::Point2f disturbed(const Eigen::Vector2d& x, const CameraIntrinsics& camera) {
    const size_t quarter = (x.x() > camera.cx ? 1U : 0U) + (x.y() > camera.cy ? 2U : 0U);
    Eigen::Vector2d y = x + common_[quarter] + vector(choices_.noise_px);
    if (uniform_(random_) < choices_.outlier_ratio)
      y += 40.0 * Eigen::Vector2d(uniform_(random_) - 0.5, uniform_(random_) - 0.5);
    return {static_cast<float>(y.x()), static_cast<float>(y.y())};
  }

 private:
  Eigen::Vector2d vector(double sigma) { return {sigma * normal_(random_), sigma * normal_(random_)}; }

  SimulationChoices choices_;
  std::mt19937 random_;
  std::normal_distribution<double> normal_;
  std::uniform_real_distribution<double> uniform_;
  std::array<Eigen::Vector2d, 4> common_{};
};

inline PointTracks simulatedPoints(const Eigen::Matrix3d& H, const CameraIntrinsics& camera, int grid_px,
                                   PointNoise& noise) {
  PointTracks tracks;
  noise.beginPair();
  for (int v = grid_px / 2; v < camera.height; v += grid_px) {
    for (int u = grid_px / 2; u < camera.width; u += grid_px) {
      ++tracks.sampled;
      const Eigen::Vector3d y = H * Eigen::Vector3d(u, v, 1);
      if (y.z() <= 0) continue;
      const Eigen::Vector2d moved = y.hnormalized();
      if (moved.x() < 0 || moved.y() < 0 || moved.x() >= camera.width || moved.y() >= camera.height) continue;
      tracks.previous.emplace_back(static_cast<float>(u), static_cast<float>(v));
      tracks.current.push_back(noise.disturbed(moved, camera));
    }
  }
  return tracks;
}

/// Camera looking 60 degrees down; mounted 1.5 to 3.5 degrees off and 5 cm away from nominal, time shift up
/// to 8 ms: all by the seed.
inline SimulatedRecording simulateRecording(const simulation::Trajectory& trajectory, unsigned seed,
                                            const SimulationChoices& choices = {}) {
  std::mt19937 random(1000 + seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  SimulatedRecording recording;
  CalibrationInput& input = recording.input;
  input.camera.width = 640;
  input.camera.height = 480;
  input.camera.fx = input.camera.fy = 500;
  input.camera.cx = 319.5;
  input.camera.cy = 239.5;
  input.nominal.R_CI = simulation::pitchedMounting(60 * kDegree);
  input.nominal.start_height_m = 2;
  input.noise = {8.7e-5, 2.0e-3, 2.0e-5, 4.0e-4};

  recording.truth = input.nominal;
  const double off = (1.5 + 2 * uniform(random)) * kDegree;
  recording.truth.R_CI = expSO3(off * randomDirection(random)) * input.nominal.R_CI;
  recording.truth.p_IC = 0.05 * randomDirection(random);
  recording.truth.timeshift_s = 0.008 * (2 * uniform(random) - 1);
  recording.gyro_bias = 0.006 * randomDirection(random);
  recording.accel_bias = 0.1 * randomDirection(random);

  constexpr int64_t kStart = 1600000000000000;
  simulation::ImuSimulatorParameters imu;
  imu.noise = input.noise;
  imu.gyro_bias = recording.gyro_bias;
  imu.accel_bias = recording.accel_bias;
  imu.seed = seed;
  input.imu = simulation::simulateImu(trajectory, -0.5, choices.duration_s + 0.5, kStart, imu);
  if (choices.altimeter) {
    input.altimeter = simulation::simulateAltimeter(trajectory, recording.truth, -0.5,
                                                    choices.duration_s + 0.5, kStart, 50, 0.05, seed);
  }
  const Eigen::Matrix3d K = Camera(input.camera).K();
  PointNoise noise(choices, seed);
  const auto frames = static_cast<int>(choices.duration_s * choices.fps);
  for (int k = 0; k < frames; ++k) {
    input.frames.push_back(kStart + std::llround(k * 1e6 / choices.fps));
    if (k == 0) continue;
    const auto exposure = [&](int frame) {
      return static_cast<double>(input.frames[static_cast<size_t>(frame)] - kStart) * 1e-6 +
             recording.truth.timeshift_s;
    };
    const PlaneMotion motion =
        simulation::exactMotion(trajectory, recording.truth, exposure(k - 1), exposure(k));
    if (k == 1) recording.truth.start_height_m = motion.h_a;
    input.ground.push_back(
        {input.frames[static_cast<size_t>(k - 1)], input.frames[static_cast<size_t>(k)],
         simulatedPoints(planeHomography(K, motion), input.camera, choices.grid_px, noise)});
  }
  return recording;
}

}  // namespace redbee::calibration
