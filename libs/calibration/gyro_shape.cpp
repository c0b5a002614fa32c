#include "redbee/calibration/gyro_shape.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

#include "redbee/geometry/median.hpp"
#include "redbee/geometry/so3.hpp"

namespace redbee::calibration {
namespace {

constexpr int kUnknowns = 12;  // S, a rotation, the rest of the bias
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

}  // namespace

Eigen::Matrix3d GyroShape::correction() const {
  Eigen::Matrix3d S;
  S << shape(0), shape(3), shape(4), shape(3), shape(1), shape(5), shape(4), shape(5), shape(2);
  return Eigen::Matrix3d::Identity() + S;
}

GyroShape estimateGyroShape(const std::vector<RatePair>& pairs, const HandEye& solution) {
  constexpr int kRounds = 6;
  constexpr double kLeastKnee = 1e-6;  // rad/s
  GyroShape result;
  const double infinity = std::numeric_limits<double>::infinity();
  result.sigma.setConstant(infinity);
  result.worst_sigma = infinity;
  if (pairs.size() < kUnknowns) return result;
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
    for (size_t i = 0; i < pairs.size(); ++i) {
      const Design J = designOf(pairs[i].imu - solution.gyro_bias);
      const Eigen::Vector3d left = residualOf(i) - J * x;
      squared[i] = left.squaredNorm();
      const Unknowns gradient = weight[i] * J.transpose() * left;
      scatter += gradient * gradient.transpose();
    }
    const double knee = std::max(2 * std::sqrt(median(squared)), kLeastKnee);
    for (size_t i = 0; i < pairs.size(); ++i) weight[i] = 1 / (1 + squared[i] / (knee * knee));
  }
  constexpr double kPairsOfAFrame = 2;  // whose errors are correlated
  const Information inverse = A.inverse();
  const Information covariance = kPairsOfAFrame * inverse * scatter * inverse;
  const Eigen::Matrix<double, 6, 6> of_shape = covariance.topLeftCorner<6, 6>();
  result.shape = x.head<6>();
  result.sigma = of_shape.diagonal().cwiseMax(0).cwiseSqrt();
  result.worst_sigma = std::sqrt(std::max(
      0.0, Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>>(of_shape).eigenvalues().maxCoeff()));
  return result;
}

}  // namespace redbee::calibration
