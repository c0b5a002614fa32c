#include "redbee/calibration/preintegration.hpp"

#include "redbee/geometry/so3.hpp"

namespace redbee::calibration {
namespace {

/// One step between two samples: mean rate, and the mean of the specific forces at both ends, each turned by
/// its own attitude.
void step(Preintegration& sum, const ImuHistory::Sample& begin, const ImuHistory::Sample& end,
          const ImuNoise& noise) {
  const double dt = end.t_s - begin.t_s;
  const Eigen::Vector3d turn = (0.5 * (begin.gyro + end.gyro) - sum.bias.gyro) * dt;
  const Eigen::Matrix3d turned = expSO3(turn);
  const Eigen::Matrix3d R_end = sum.R * turned;
  const Eigen::Vector3d force_begin = begin.accel - sum.bias.accel;
  const Eigen::Vector3d force_end = end.accel - sum.bias.accel;
  const Eigen::Vector3d acceleration = 0.5 * (sum.R * force_begin + R_end * force_end);
  const Eigen::Matrix3d R_mean = 0.5 * (sum.R + R_end);
  const Eigen::Matrix3d force_by_turn = -0.5 * (sum.R * skew(force_begin) + R_end * skew(force_end));
  const Eigen::Matrix3d Jr = rightJacobianSO3(turn);

  const Eigen::Matrix3d a_by_gyro = force_by_turn * sum.R_by_gyro;
  sum.p_by_gyro += sum.v_by_gyro * dt + 0.5 * dt * dt * a_by_gyro;
  sum.p_by_accel += sum.v_by_accel * dt - 0.5 * dt * dt * R_mean;
  sum.v_by_gyro += dt * a_by_gyro;
  sum.v_by_accel -= dt * R_mean;
  sum.R_by_gyro = turned.transpose() * sum.R_by_gyro - Jr * dt;

  Matrix9d F = Matrix9d::Identity();
  F.block<3, 3>(0, 0) = turned.transpose();
  F.block<3, 3>(3, 0) = dt * force_by_turn;
  F.block<3, 3>(6, 0) = 0.5 * dt * dt * force_by_turn;
  F.block<3, 3>(6, 3) = dt * Eigen::Matrix3d::Identity();
  Eigen::Matrix<double, 9, 6> G = Eigen::Matrix<double, 9, 6>::Zero();
  G.block<3, 3>(0, 0) = Jr * dt;
  G.block<3, 3>(3, 3) = R_mean * dt;
  G.block<3, 3>(6, 3) = 0.5 * dt * dt * R_mean;
  Eigen::Matrix<double, 6, 1> variance;
  variance << Eigen::Vector3d::Constant(noise.gyro_noise_density * noise.gyro_noise_density / dt),
      Eigen::Vector3d::Constant(noise.accel_noise_density * noise.accel_noise_density / dt);
  sum.covariance = F * sum.covariance * F.transpose() + G * variance.asDiagonal() * G.transpose();

  sum.p += sum.v * dt + 0.5 * dt * dt * acceleration;
  sum.v += dt * acceleration;
  sum.R = nearestRotation(R_end);
  sum.dt_s += dt;
}

}  // namespace

Preintegration preintegrate(const ImuHistory& imu, double from_s, double to_s, const Bias& bias,
                            const ImuNoise& noise) {
  Preintegration sum;
  sum.bias = bias;
  const auto samples = imu.between(from_s, to_s);
  for (size_t i = 0; i + 1 < samples.size(); ++i) {
    if (samples[i + 1].t_s > samples[i].t_s) step(sum, samples[i], samples[i + 1], noise);
  }
  return sum;
}

}  // namespace redbee::calibration
