#include "redbee/geometry/homography.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <limits>

#include "redbee/geometry/products.hpp"
#include "redbee/geometry/row_major.hpp"
#include "redbee/geometry/so3.hpp"

namespace redbee {
namespace {

using Matrix98d = Eigen::Matrix<double, 9, 8>;
using Matrix9d = Eigen::Matrix<double, 9, 9>;

/// vec(L X R) = rowwise(L, R) vec(X), vec row by row.
Matrix9d rowwiseProduct(const Eigen::Matrix3d& L, const Eigen::Matrix3d& R) {
  Matrix9d P;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) P.block<3, 3>(3 * i, 3 * j) = L(i, j) * R.transpose();
  }
  return P;
}

Eigen::Matrix<double, 9, 1> stackRows(const Eigen::Matrix3d& M) {
  const RowMajor3d rows = M;
  return Eigen::Map<const Eigen::Matrix<double, 9, 1>>(rows.data());
}

/// Pixels, by the logarithm of the focal length: x - c.
Eigen::Matrix3d aboutPrincipalPoint(const Eigen::Matrix3d& K) {
  Eigen::Matrix3d change = Eigen::Matrix3d::Zero();
  change(0, 0) = change(1, 1) = 1;
  change.block<2, 1>(0, 2) = -K.block<2, 1>(0, 2);
  return change;
}

}  // namespace

ImageScaling::ImageScaling(int width, int height) : unit_px(width / 2.0) {
  const double cx = (width - 1) / 2.0;
  const double cy = (height - 1) / 2.0;
  T << 1 / unit_px, 0, -cx / unit_px, 0, 1 / unit_px, -cy / unit_px, 0, 0, 1;
  T_inverse << unit_px, 0, cx, 0, unit_px, cy, 0, 0, 1;
}

Eigen::Matrix3d ImageScaling::scale(const Eigen::Matrix3d& H_px) const {
  return normaliseHomography(T * H_px * T_inverse);
}

Eigen::Matrix3d ImageScaling::unscale(const Eigen::Matrix3d& H_scaled) const {
  return normaliseHomography(T_inverse * H_scaled * T);
}

Eigen::Matrix3d normaliseHomography(const Eigen::Matrix3d& H) { return H / H(2, 2); }

Vector8d toVector(const Eigen::Matrix3d& H) { return stackRows(H).head<8>() / H(2, 2); }

Eigen::Matrix3d fromVector(const Vector8d& h) {
  Eigen::Matrix3d H;
  H << h(0), h(1), h(2), h(3), h(4), h(5), h(6), h(7), 1.0;
  return H;
}

Eigen::Vector2d transfer(const Eigen::Matrix3d& H, const Eigen::Vector2d& x) {
  return (H * x.homogeneous()).hnormalized();
}

Eigen::Matrix<double, 2, 8> transferJacobian(const Eigen::Matrix3d& H, const Eigen::Vector2d& x) {
  const Eigen::Vector3d y = H * x.homogeneous();
  const Eigen::Vector2d p = y.hnormalized();
  Eigen::Matrix<double, 2, 8> J = Eigen::Matrix<double, 2, 8>::Zero();
  J.block<1, 3>(0, 0) = x.homogeneous().transpose();
  J.block<1, 3>(1, 3) = x.homogeneous().transpose();
  J.block<2, 2>(0, 6) = -p * x.transpose();
  return J / y.z();
}

Eigen::Matrix<double, 2, 2, Eigen::RowMajor> transferCovariance(const Eigen::Matrix<double, 2, 8>& J,
                                                                const Matrix8d& P) {
  const Eigen::Matrix<double, 2, 8> JP = J.lazyProduct(P);
  return JP.lazyProduct(J.transpose());
}

Eigen::Matrix2d transferJacobianPoint(const Eigen::Matrix3d& H, const Eigen::Vector2d& x) {
  const Eigen::Vector3d y = H * x.homogeneous();
  return (H.topLeftCorner<2, 2>() - y.hnormalized() * H.block<1, 2>(2, 0)) / y.z();
}

Eigen::Matrix<double, 8, 9> projectionJacobian(const Eigen::Matrix3d& M) {
  Eigen::Matrix<double, 8, 9> J = Eigen::Matrix<double, 8, 9>::Zero();
  J.leftCols<8>().setIdentity();
  J.col(8) = -toVector(M);
  return J / M(2, 2);
}

ComposeJacobians composeJacobians(const Eigen::Matrix3d& A, const Eigen::Matrix3d& B) {
  const Eigen::Matrix<double, 8, 9> project = projectionJacobian(A * B);
  const Eigen::Matrix3d I = Eigen::Matrix3d::Identity();
  return {product(project, Matrix98d(rowwiseProduct(I, B).leftCols<8>())),
          product(project, Matrix98d(rowwiseProduct(A, I).leftCols<8>()))};
}

Matrix8d inverseJacobian(const Eigen::Matrix3d& H) {
  const Eigen::Matrix3d inverse = H.inverse();
  return product(projectionJacobian(inverse), Matrix98d(-rowwiseProduct(inverse, inverse).leftCols<8>()));
}

Eigen::Matrix3d planeHomography(const CameraPair& cameras, const PlaneMotion& motion) {
  const Eigen::Matrix3d euclidean = motion.R_ba + motion.t_ba * motion.m_a.transpose() / motion.h_a;
  return normaliseHomography(cameras.K_b * euclidean * cameras.K_a.inverse());
}

Eigen::Vector3d translationFromHomography(const CameraPair& cameras, const Eigen::Matrix3d& H,
                                          const PlaneMotion& motion) {
  const auto& [R, t, m, h] = motion;
  const Eigen::Matrix3d euclidean = cameras.K_b.inverse() * H * cameras.K_a;
  Eigen::Matrix<double, 3, 2> within;
  within.col(0) = m.unitOrthogonal();
  within.col(1) = m.cross(within.col(0));
  const Eigen::Matrix<double, 3, 2> moved = euclidean * within;
  const double scale = moved.cwiseProduct(R * within).sum() / moved.squaredNorm();
  return h * (scale * euclidean - R) * m;
}

PlaneHomographyJacobians planeHomographyJacobians(const CameraPair& cameras, const PlaneMotion& motion) {
  const auto& [R, t, m, h] = motion;
  const Eigen::Matrix3d K_inverse = cameras.K_a.inverse();
  const Eigen::Matrix3d H = cameras.K_b * (R + t * m.transpose() / h) * K_inverse;
  const Eigen::Matrix<double, 8, 9> project = projectionJacobian(H);
  const auto column = [&](const Eigen::Matrix3d& change) -> Vector8d {
    return project * stackRows(cameras.K_b * change * K_inverse);
  };
  PlaneHomographyJacobians J;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d axis = Eigen::Vector3d::Unit(i);
    J.by_rotation.col(i) = column(skew(axis) * R);
    J.by_translation.col(i) = column(axis * m.transpose() / h);
    J.by_normal.col(i) = column(t * (skew(axis) * m).transpose() / h);
  }
  J.by_height = column(-t * m.transpose() / (h * h));
  J.by_zoom_b = project * stackRows(aboutPrincipalPoint(cameras.K_b) * H);
  J.by_zoom_a = -project * stackRows(H * aboutPrincipalPoint(cameras.K_a));
  return J;
}

double meanTransferError(const Eigen::Matrix3d& A, const Eigen::Matrix3d& B, int width, int height) {
  constexpr int kGrid = 16;
  double sum = 0;
  int count = 0;
  for (int v = kGrid / 2; v < height; v += kGrid) {
    for (int u = kGrid / 2; u < width; u += kGrid) {
      const Eigen::Vector3d a = A * Eigen::Vector3d(u, v, 1);
      const Eigen::Vector3d b = B * Eigen::Vector3d(u, v, 1);
      if (a.z() <= 0 || b.z() <= 0) continue;
      sum += (a.hnormalized() - b.hnormalized()).norm();
      ++count;
    }
  }
  return count > 0 ? sum / count : std::numeric_limits<double>::infinity();
}

}  // namespace redbee
