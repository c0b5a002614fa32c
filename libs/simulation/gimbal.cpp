#include "redbee/simulation/gimbal.hpp"

#include <random>

#include "redbee/geometry/so3.hpp"

namespace redbee::simulation {

Eigen::Matrix3d Gimbal::R_MI(const Trajectory& trajectory, double t_s) const {
  const Eigen::Matrix3d R_XM = expSO3({0, 0, yaw_pitch_roll[0].at(t_s)}) *
                               expSO3({0, yaw_pitch_roll[1].at(t_s), 0}) *
                               expSO3({yaw_pitch_roll[2].at(t_s), 0, 0});
  if (!is_stabilised) return R_XM.transpose();
  return R_XM.transpose() * trajectory.at(t_s).R_GI;
}

std::vector<MountSample> simulateGimbal(const Gimbal& gimbal, const Trajectory& trajectory, double begin_s,
                                        double end_s, ImuTime start) {
  std::mt19937 random(gimbal.errors.seed);
  std::normal_distribution<double> normal;
  std::vector<MountSample> samples;
  for (int k = 0; begin_s + k / gimbal.rate_hz <= end_s; ++k) {
    const ImuTime time = start + fromSeconds(begin_s + k / gimbal.rate_hz);
    const double when_s = seconds(time - start) - gimbal.errors.lag_s;
    const double x = normal(random), y = normal(random), z = normal(random);
    const Eigen::Vector3d error = gimbal.errors.bias + gimbal.errors.noise_sigma * Eigen::Vector3d(x, y, z);
    const Eigen::Matrix3d R_IM = gimbal.R_MI(trajectory, when_s).transpose() * expSO3(error);
    samples.push_back({time, Eigen::Quaterniond(R_IM)});
  }
  return samples;
}

}  // namespace redbee::simulation
