#include "redbee/geometry/so3.hpp"

#include <Eigen/SVD>
#include <cmath>

namespace redbee {

Eigen::Matrix3d skew(const Eigen::Vector3d& v) {
  Eigen::Matrix3d S;
  S << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return S;
}

Eigen::Matrix3d expSO3(const Eigen::Vector3d& phi) {
  const double angle = phi.norm();
  const Eigen::Matrix3d S = skew(phi);
  // Below 1e-5 rad the series is exact to double precision, and sin(x)/x is not.
  const double a = angle < 1e-5 ? 1.0 - angle * angle / 6.0 : std::sin(angle) / angle;
  const double b = angle < 1e-5 ? 0.5 - angle * angle / 24.0 : (1.0 - std::cos(angle)) / (angle * angle);
  return Eigen::Matrix3d::Identity() + a * S + b * S * S;
}

Eigen::Vector3d logSO3(const Eigen::Matrix3d& R) {
  const Eigen::Quaterniond q(R);
  const double sign = q.w() < 0 ? -1.0 : 1.0;
  const Eigen::Vector3d v = sign * q.vec();
  const double sine = v.norm();
  if (sine < 1e-9) return 2.0 * v;
  return 2.0 * std::atan2(sine, sign * q.w()) / sine * v;
}

Eigen::Matrix3d rightJacobianSO3(const Eigen::Vector3d& phi) {
  const double angle = phi.norm();
  const Eigen::Matrix3d S = skew(phi);
  if (angle < 1e-4) return Eigen::Matrix3d::Identity() - 0.5 * S + S * S / 6.0;
  const double square = angle * angle;
  return Eigen::Matrix3d::Identity() - (1.0 - std::cos(angle)) / square * S +
         (angle - std::sin(angle)) / (square * angle) * S * S;
}

Eigen::Matrix3d nearestRotation(const Eigen::Matrix3d& M) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(M, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d signs(1.0, 1.0, 1.0);
  if ((svd.matrixU() * svd.matrixV().transpose()).determinant() < 0) signs.z() = -1.0;
  return svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
}

Eigen::Quaterniond rotationBetween(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  constexpr double kOpposite = 1e-12;  // of the cosine
  const Eigen::Vector3d a = from.normalized();
  const Eigen::Vector3d b = to.normalized();
  const double cosine = b.dot(a);
  Eigen::Quaterniond q;
  if (cosine < -1 + kOpposite) {
    q.w() = 0;
    q.vec() = a.unitOrthogonal();
    return q;
  }
  const double twice_w = std::sqrt((1 + cosine) * 2);
  q.vec() = a.cross(b) * (1 / twice_w);
  q.w() = 0.5 * twice_w;
  return q;
}

bool isRotation(const Eigen::Matrix3d& R, double tolerance) {
  return R.allFinite() &&
         (R * R.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() <= tolerance &&
         R.determinant() > 0;
}

}  // namespace redbee
