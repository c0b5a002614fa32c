#include "redbee/calibration/gyro_shape.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

#include "redbee/geometry/chi_square.hpp"
#include "redbee/geometry/median.hpp"
#include "redbee/geometry/so3.hpp"

namespace redbee::calibration {
namespace {

constexpr int kUnknowns = 12;  // S, a rotation, the rest of the bias
// Relative errors that a calibration of the lens leaves: of the focal length, and of all else (aspect,
// distortion).
constexpr double kFocalSigma = 0.002, kLensSigma = 0.0005;
using Design = Eigen::Matrix<double, 3, kUnknowns>;
using Unknowns = Eigen::Matrix<double, kUnknowns, 1>;
using Information = Eigen::Matrix<double, kUnknowns, kUnknowns>;

Design designOf(const Eigen::Vector3d& w) {
  Design J = Design::Zero();
  J(0, 0) = w.x();
  J(1, 1) = w.y();
  J(2, 2) = w.z();
  J(0, 3) = w.y();
  J(1, 3) = w.x();
  J(0, 4) = w.z();
  J(2, 4) = w.x();
  J(1, 5) = w.z();
  J(2, 5) = w.y();
  J.middleCols<3>(6) = -skew(w);
  J.rightCols<3>().setIdentity();
  return J;
}

/// Images that are too large by a part e show rotations about the camera's x and y axes as too large by e.
Vector6d scaleByFocalLength(const Eigen::Matrix3d& R_CI) {
  const Eigen::Matrix3d S = R_CI.transpose() * Eigen::Vector3d(1, 1, 0).asDiagonal() * R_CI;
  Vector6d shape;
  shape << S.diagonal(), S(0, 1), S(0, 2), S(1, 2);
  return shape;
}

}  // namespace

Eigen::Matrix3d GyroShape::correction() const {
  Eigen::Matrix3d S;
  S << shape(0), shape(3), shape(4), shape(3), shape(1), shape(5), shape(4), shape(5), shape(2);
  return Eigen::Matrix3d::Identity() + S;
}

double GyroShape::worstSigma() const {
  if (!covariance.allFinite()) return std::numeric_limits<double>::infinity();
  return std::sqrt(
      std::max(0.0, Eigen::SelfAdjointEigenSolver<Matrix6d>(covariance).eigenvalues().maxCoeff()));
}

bool GyroShape::isSignificant() const {
  constexpr double kCertain = 0.9973;  // three sigma
  return covariance.allFinite() && shape.dot(covariance.ldlt().solve(shape)) > chiSquareQuantile(kCertain, 6);
}

GyroShape estimateGyroShape(const std::vector<RatePair>& pairs, const HandEye& solution) {
  constexpr int kRounds = 6;
  // Of the recording, in time: within a part the pairs' errors, of frames in common and of the same motion,
  // are correlated, so that the scatter is that of the parts' sums (cluster-robust, Liang and Zeger 1986).
  constexpr size_t kParts = 36;
  constexpr double kLeastKnee = 1e-6;  // rad/s
  GyroShape result;
  result.covariance.diagonal().setConstant(std::numeric_limits<double>::infinity());
  if (pairs.size() < 2 * kParts) return result;
  std::vector<double> squared(pairs.size(), 0.0), weight(pairs.size(), 1.0);
  Unknowns x = Unknowns::Zero();
  Information A, scatter;
  for (int round = 0; round < kRounds; ++round) {
    A.setZero();
    scatter.setZero();
    Unknowns b = Unknowns::Zero();
    const auto residualOf = [&](size_t i) -> Eigen::Vector3d {
      return solution.R_CI.transpose() * pairs[i].camera - (pairs[i].imu - solution.gyro_bias);
    };
    for (size_t i = 0; i < pairs.size(); ++i) {
      const Design J = designOf(pairs[i].imu - solution.gyro_bias);
      A += weight[i] * J.transpose() * J;
      b += weight[i] * J.transpose() * residualOf(i);
    }
    const Eigen::SelfAdjointEigenSolver<Information> eigen(A);
    const double least = 1e-9 * eigen.eigenvalues().maxCoeff();
    if (eigen.eigenvalues().minCoeff() <= least) return result;
    x = A.ldlt().solve(b);
    Unknowns of_part = Unknowns::Zero();
    for (size_t i = 0; i < pairs.size(); ++i) {
      const Design J = designOf(pairs[i].imu - solution.gyro_bias);
      const Eigen::Vector3d left = residualOf(i) - J * x;
      squared[i] = left.squaredNorm();
      of_part += weight[i] * J.transpose() * left;
      const bool is_last_of_part = (i + 1) * kParts / pairs.size() != i * kParts / pairs.size();
      if (!is_last_of_part) continue;
      scatter += of_part * of_part.transpose();
      of_part.setZero();
    }
    const double knee = std::max(2 * std::sqrt(median(squared)), kLeastKnee);
    for (size_t i = 0; i < pairs.size(); ++i) weight[i] = 1 / (1 + squared[i] / (knee * knee));
  }
  constexpr double kFreedom = static_cast<double>(kParts) / (kParts - kUnknowns);
  const Information inverse = A.inverse();
  const Information covariance = kFreedom * inverse * scatter * inverse;
  const Vector6d focal = kFocalSigma * scaleByFocalLength(solution.R_CI);
  result.shape = x.head<6>();
  result.lens_covariance = focal * focal.transpose() + kLensSigma * kLensSigma * Matrix6d::Identity();
  result.covariance = covariance.topLeftCorner<6, 6>() + result.lens_covariance;
  return result;
}

}  // namespace redbee::calibration
