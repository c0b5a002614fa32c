// Simulated calibration inputs without images: ground points moved by the exact homographies of an analytic
// trajectory.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <random>
#include <utility>

#include "redbee/calibration/calibration.hpp"
#include "redbee/geometry/angle.hpp"
#include "redbee/geometry/so3.hpp"
#include "redbee/simulation/camera_pose.hpp"
#include "redbee/simulation/scenarios.hpp"
#include "redbee/simulation/trajectory.hpp"
#include "tests/support/consumer_imu.hpp"
#include "tests/support/simulated_flight.hpp"

namespace redbee::test {

struct SimulatedRecording {
  calibration::CalibrationInput input;
  InertialExtrinsics truth;
  Eigen::Vector3d gyro_bias;
  Eigen::Vector3d accel_bias;
};

struct RecordingOptions {
  double duration_s = 12;
  double fps = 24;
  double noise_px = 0.15;  ///< per axis, white
  double common_noise_px =
      0;                     ///< per axis, shared by all points of a quarter of the image: correlated errors
  double outlier_ratio = 0;  ///< of the points
  bool altimeter = false;
  double height_m = 6;
  int grid_px = 32;
  double readout_s = 0;  ///< of a rolling shutter
  /// Measured rates are these times the true ones.
  Eigen::Matrix3d gyro_axes = Eigen::Matrix3d::Identity();
};

inline Eigen::Vector3d randomDirection(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
}

class PointNoise {
 public:
  PointNoise(const RecordingOptions& options, unsigned seed) : options_(options), random_(seed) {}

  void beginPair() {
    for (auto& shift : common_) shift = vector(options_.common_noise_px);
  }
  cv::Point2f disturbed(const Eigen::Vector2d& x, const CameraIntrinsics& camera) {
    const size_t quarter = (x.x() > camera.cx ? 1U : 0U) + (x.y() > camera.cy ? 2U : 0U);
    Eigen::Vector2d y = x + common_[quarter] + vector(options_.noise_px);
    if (uniform_(random_) < options_.outlier_ratio)
      y += 40.0 * Eigen::Vector2d(uniform_(random_) - 0.5, uniform_(random_) - 0.5);
    return {static_cast<float>(y.x()), static_cast<float>(y.y())};
  }

 private:
  Eigen::Vector2d vector(double sigma) { return {sigma * normal_(random_), sigma * normal_(random_)}; }

  RecordingOptions options_;
  std::mt19937 random_;
  std::normal_distribution<double> normal_;
  std::uniform_real_distribution<double> uniform_;
  std::array<Eigen::Vector2d, 4> common_{};
};

/// `move`: from a pixel to where the next frame shows the same ground, std::nullopt if it does not.
template <typename Move>
PointTracks simulatedPoints(const Move& move, const CameraIntrinsics& camera, int grid_px,
                            PointNoise& noise) {
  PointTracks tracks;
  noise.beginPair();
  for (int v = grid_px / 2; v < camera.height; v += grid_px) {
    for (int u = grid_px / 2; u < camera.width; u += grid_px) {
      ++tracks.sampled;
      const std::optional<Eigen::Vector2d> moved = move({u, v});
      if (!moved || moved->x() < 0 || moved->y() < 0 || moved->x() >= camera.width ||
          moved->y() >= camera.height)
        continue;
      tracks.previous.emplace_back(static_cast<float>(u), static_cast<float>(v));
      tracks.current.push_back(noise.disturbed(*moved, camera));
    }
  }
  return tracks;
}

/// The ground from one frame of a rolling shutter to another, by the camera's poses at the rows' times.
class RollingGround {
 public:
  /// Pose of the camera at the time of one row of a frame.
  using PoseOfRow = std::function<simulation::CameraPose(double row)>;
  RollingGround(PoseOfRow a, PoseOfRow b) : a_(std::move(a)), b_(std::move(b)) {}

  std::optional<Eigen::Vector2d> operator()(const Eigen::Vector2d& from) const {
    const simulation::CameraPose a = a_(from.y());
    const Eigen::Vector3d ray = a.R_CG.transpose() * camera().K_inverse() * from.homogeneous();
    if (ray.z() >= 0) return std::nullopt;
    const Eigen::Vector3d X = a.p_GC - ray * (a.p_GC.z() / ray.z());
    Eigen::Vector2d to = from;
    for (int i = 0; i < 8; ++i) {
      const simulation::CameraPose b = b_(to.y());
      const Eigen::Vector3d X_C = b.R_CG * (X - b.p_GC);
      if (X_C.z() <= 0) return std::nullopt;
      to = (camera().K() * X_C).hnormalized();
    }
    return to;
  }

 private:
  PoseOfRow a_, b_;
};

/// Camera pitched 60 degrees down; the true mounting deviates by 1.5 to 3.5 degrees and 5 cm from nominal,
/// time shift up to 8 ms, depending on the seed.
inline SimulatedRecording simulateRecording(const simulation::Trajectory& trajectory, unsigned seed,
                                            const RecordingOptions& options = {}) {
  std::mt19937 random(1000 + seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  SimulatedRecording recording;
  calibration::CalibrationInput& input = recording.input;
  input.camera = intrinsics();
  input.nominal.R_CI = simulation::pitchedMounting(60 * kDegree);
  input.nominal.start_height_m = 2;
  input.noise = consumerNoise();
  input.noise.accel_noise_density = 2.0e-3;

  recording.truth = input.nominal;
  const double off = (1.5 + 2 * uniform(random)) * kDegree;
  recording.truth.R_CI = expSO3(off * randomDirection(random)) * input.nominal.R_CI;
  recording.truth.p_IC = 0.05 * randomDirection(random);
  recording.truth.timeshift_s = 0.008 * (2 * uniform(random) - 1);
  recording.gyro_bias = 0.006 * randomDirection(random);
  recording.accel_bias = 0.1 * randomDirection(random);

  constexpr CameraTime kRecordingStart(std::chrono::seconds(1600000000));
  const SimulatedFlight flight(trajectory, recording.truth, kRecordingStart);
  ConsumerImu imu(seed);
  imu.noise = input.noise;
  imu.gyro_bias = recording.gyro_bias;
  imu.accel_bias = recording.accel_bias;
  input.imu = flight.imu(imu, options.duration_s + 0.5);
  for (ImuSample& sample : input.imu) sample.gyro = options.gyro_axes * sample.gyro;
  const auto poseOfRow = [&](CameraTime frame) -> RollingGround::PoseOfRow {
    return [&, frame](double row) {
      const double row_s = (row - 0.5 * (kHeight - 1)) * options.readout_s / kHeight;
      const double t_s = seconds(frame - kRecordingStart) + recording.truth.timeshift_s + row_s;
      return simulation::cameraPose(trajectory.at(t_s), recording.truth);
    };
  };
  if (options.altimeter) input.altimeter = flight.altimeter(-0.5, options.duration_s + 0.5, seed);
  PointNoise noise(options, seed);
  const auto frames = static_cast<int>(options.duration_s * options.fps);
  for (int k = 0; k < frames; ++k) {
    input.frames.push_back(frameTime(k, kRecordingStart, options.fps));
    if (k == 0) continue;
    const CameraTime previous = input.frames[static_cast<size_t>(k - 1)];
    const RollingGround move(poseOfRow(previous), poseOfRow(input.frames.back()));
    input.ground.push_back(
        {previous, input.frames.back(), simulatedPoints(move, input.camera, options.grid_px, noise)});
  }
  recording.truth.start_height_m = flight.heightAt(kRecordingStart);
  return recording;
}

}  // namespace redbee::test
