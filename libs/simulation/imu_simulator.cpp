#include "redbee/simulation/imu_simulator.hpp"

#include <cmath>
#include <random>

#include "redbee/simulation/camera_pose.hpp"

namespace redbee::simulation {
namespace {

/// How many samples of this rate fit on [begin_s, end_s], both ends included.
int64_t sampleCount(double begin_s, double end_s, double rate_hz) {
  return end_s < begin_s ? 0 : static_cast<int64_t>(std::floor((end_s - begin_s) * rate_hz + 1e-9)) + 1;
}

class WhiteNoise {
 public:
  explicit WhiteNoise(unsigned seed) : random_(seed) {}
  Eigen::Vector3d vector(double sigma) { return {scalar(sigma), scalar(sigma), scalar(sigma)}; }
  double scalar(double sigma) { return sigma * normal_(random_); }

 private:
  std::mt19937 random_;
  std::normal_distribution<double> normal_;
};

Eigen::Vector3d specificForce(const TrajectoryState& state, double gravity) {
  return state.R_GI.transpose() * (state.a_GI + gravity * Eigen::Vector3d::UnitZ());
}

}  // namespace

std::vector<ImuSample> simulateImu(const Trajectory& trajectory, double begin_s, double end_s, ImuTime start,
                                   const ImuSimulatorParameters& parameters) {
  const ImuNoise& noise = parameters.noise;
  const double root_rate = std::sqrt(parameters.rate_hz);
  WhiteNoise random(parameters.seed);
  Eigen::Vector3d gyro_bias = parameters.gyro_bias;
  Eigen::Vector3d accel_bias = parameters.accel_bias;

  std::vector<ImuSample> samples;
  const int64_t count = sampleCount(begin_s, end_s, parameters.rate_hz);
  samples.reserve(static_cast<size_t>(count));
  for (int64_t k = 0; k < count; ++k) {
    // Sampled at the rounded time stamp, so that a perfect IMU stays exact at periods that are no whole
    // microseconds.
    const ImuTime time = start + fromSeconds(begin_s + static_cast<double>(k) / parameters.rate_hz);
    const TrajectoryState state = trajectory.at(seconds(time - start));
    samples.push_back({time, state.omega_I + gyro_bias + random.vector(noise.gyro_noise_density * root_rate),
                       specificForce(state, parameters.gravity) + accel_bias +
                           random.vector(noise.accel_noise_density * root_rate)});
    gyro_bias += random.vector(noise.gyro_random_walk / root_rate);
    accel_bias += random.vector(noise.accel_random_walk / root_rate);
  }
  return samples;
}

std::vector<AltitudeSample> simulateAltimeter(const Trajectory& trajectory,
                                              const InertialExtrinsics& extrinsics, double begin_s,
                                              double end_s, ImuTime start, double rate_hz, double sigma_m,
                                              unsigned seed) {
  WhiteNoise random(seed);
  std::vector<AltitudeSample> samples;
  const int64_t count = sampleCount(begin_s, end_s, rate_hz);
  samples.reserve(static_cast<size_t>(count));
  for (int64_t k = 0; k < count; ++k) {
    const ImuTime time = start + fromSeconds(begin_s + static_cast<double>(k) / rate_hz);
    const CameraPose pose = cameraPose(trajectory.at(seconds(time - start)), extrinsics);
    samples.push_back({time, pose.p_GC.z() + random.scalar(sigma_m), sigma_m});
  }
  return samples;
}

PlaneMotion exactMotion(const Trajectory& trajectory, const InertialExtrinsics& extrinsics, double t_a,
                        double t_b) {
  const CameraPose a = cameraPose(trajectory.at(t_a), extrinsics);
  const CameraPose b = cameraPose(trajectory.at(t_b), extrinsics);
  return {b.R_CG * a.R_CG.transpose(), b.R_CG * (a.p_GC - b.p_GC), -a.R_CG.col(2), a.p_GC.z()};
}

}  // namespace redbee::simulation
