#include "redbee/calibration/hand_eye.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "redbee/geometry/median.hpp"
#include "redbee/geometry/so3.hpp"

namespace redbee::calibration {
namespace {

struct Moments {
  double weight = 0;
  Eigen::Vector3d mean_camera = Eigen::Vector3d::Zero();
  Eigen::Vector3d mean_imu = Eigen::Vector3d::Zero();
  Eigen::Matrix3d cross = Eigen::Matrix3d::Zero();  ///< of camera and IMU rates, centred, per unit weight
};

Moments momentsOf(const std::vector<RatePair>& pairs, const std::vector<double>& weights) {
  Moments m;
  for (size_t i = 0; i < pairs.size(); ++i) {
    m.weight += weights[i];
    m.mean_camera += weights[i] * pairs[i].camera;
    m.mean_imu += weights[i] * pairs[i].imu;
  }
  m.mean_camera /= m.weight;
  m.mean_imu /= m.weight;
  for (size_t i = 0; i < pairs.size(); ++i) {
    m.cross +=
        weights[i] / m.weight * (pairs[i].camera - m.mean_camera) * (pairs[i].imu - m.mean_imu).transpose();
  }
  return m;
}

/// Standard deviations about the principal axes: information is the rates' scatter across each axis, over the
/// noise.
Eigen::Vector3d alignmentSigma(const std::vector<RatePair>& pairs, const std::vector<double>& weights,
                               const Moments& m, double residual) {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  for (size_t i = 0; i < pairs.size(); ++i) {
    const Eigen::Matrix3d S = skew(pairs[i].imu - m.mean_imu);
    information += weights[i] * S.transpose() * S;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(information);
  const double variance = std::max(residual * residual, 1e-18);
  return (variance / eigen.eigenvalues().cwiseMax(1e-12).array()).sqrt();
}

}  // namespace

Eigen::Vector3d handEyeResidual(const RatePair& pair, const HandEye& solution) {
  return pair.camera - solution.R_CI * (pair.imu - solution.gyro_bias);
}

HandEye solveHandEye(const std::vector<RatePair>& pairs, double scale) {
  constexpr int kRounds = 8;
  constexpr double kScaleFloor = 1e-6;  // rad/s
  std::vector<double> weights(pairs.size(), 1.0);
  std::vector<double> squared(pairs.size(), 0.0);
  HandEye solution;
  for (int round = 0; round < kRounds; ++round) {
    const Moments m = momentsOf(pairs, weights);
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(m.cross);
    solution.R_CI = nearestRotation(m.cross);
    solution.gyro_bias = m.mean_imu - solution.R_CI.transpose() * m.mean_camera;
    solution.excitation = svd.singularValues().cwiseSqrt();
    for (size_t i = 0; i < pairs.size(); ++i) squared[i] = handEyeResidual(pairs[i], solution).squaredNorm();

    double weighted = 0, sum = 0, cost = 0;
    const double knee = std::max(scale > 0 ? scale : 2.0 * std::sqrt(median(squared)), kScaleFloor);
    for (size_t i = 0; i < pairs.size(); ++i) {
      weighted += weights[i] * squared[i];
      sum += weights[i];
      cost += knee * knee * std::log1p(squared[i] / (knee * knee));
      weights[i] = 1.0 / (1.0 + squared[i] / (knee * knee));
    }
    solution.residual = std::sqrt(weighted / (3.0 * sum));
    solution.cost = cost / static_cast<double>(pairs.size());
    solution.sigma = alignmentSigma(pairs, weights, m, solution.residual);
  }
  return solution;
}

}  // namespace redbee::calibration
