// Plane homographies between two camera frames, and their derivatives.
//
// A homography H_ba maps pixels of frame a to pixels of frame b: x_b ~ H_ba x_a. It is normalised to h33 = 1,
// and its eight free entries are stacked row by row: h11 h12 h13 h21 h22 h23 h31 h32.
//
// In pixels these entries span six orders of magnitude. Covariances are therefore always given for the
// *scaled* homography T H T^-1 (Hartley), with T = ImageScaling(width, height).T: the image's centre at the
// origin, half its width as the unit. One such unit of h13 or h23 is width / 2 pixels.
#pragma once

#include <Eigen/Core>
#include <utility>

namespace redbee {

using Vector8d = Eigen::Matrix<double, 8, 1>;
using Matrix8d = Eigen::Matrix<double, 8, 8>;

/// Hartley's scaling for an image's size, the same for every frame of one camera.
struct ImageScaling {
  ImageScaling(int width, int height);

  /// Scaled homography T H T^-1, h33 = 1.
  Eigen::Matrix3d scale(const Eigen::Matrix3d& H_px) const;
  /// Pixel homography T^-1 H T, h33 = 1.
  Eigen::Matrix3d unscale(const Eigen::Matrix3d& H_scaled) const;

  Eigen::Matrix3d T;          ///< pixels to scaled coordinates
  Eigen::Matrix3d T_inverse;  ///< scaled coordinates to pixels
  double unit_px;             ///< pixels in one scaled unit
};

/// H / h33.
Eigen::Matrix3d normaliseHomography(const Eigen::Matrix3d& H);
/// The eight free entries of H / h33, row by row.
Vector8d toVector(const Eigen::Matrix3d& H);
Eigen::Matrix3d fromVector(const Vector8d& h);

/// The point H x in inhomogeneous coordinates.
Eigen::Vector2d transfer(const Eigen::Matrix3d& H, const Eigen::Vector2d& x);
/// d transfer(H, x) / d toVector(H), for H with h33 = 1.
Eigen::Matrix<double, 2, 8> transferJacobian(const Eigen::Matrix3d& H, const Eigen::Vector2d& x);
/// J P J', the covariance of the transferred point by that of the homography.
Eigen::Matrix<double, 2, 2, Eigen::RowMajor> transferCovariance(const Eigen::Matrix<double, 2, 8>& J,
                                                                const Matrix8d& P);
/// d transfer(H, x) / d x.
Eigen::Matrix2d transferJacobianPoint(const Eigen::Matrix3d& H, const Eigen::Vector2d& x);

/// d toVector(A B) / d toVector(A) and / d toVector(B), for A and B with h33 = 1; includes the division by (A
/// B)_33.
struct ComposeJacobians {
  Matrix8d by_left;
  Matrix8d by_right;
};
ComposeJacobians composeJacobians(const Eigen::Matrix3d& A, const Eigen::Matrix3d& B);
/// d toVector(H^-1) / d toVector(H), for H with h33 = 1.
Matrix8d inverseJacobian(const Eigen::Matrix3d& H);
/// d toVector(M) / d vec(M), vec row by row over all nine entries: the normalisation to h33 = 1.
Eigen::Matrix<double, 8, 9> projectionJacobian(const Eigen::Matrix3d& M);

/// Relative pose of two camera frames a, b over a plane.
/// Plane in frame a: m_a' X = h_a, m_a the unit normal from the camera towards the plane, h_a > 0 its
/// distance [m].
struct PlaneMotion {
  Eigen::Matrix3d R_ba;  ///< turns coordinates in a into coordinates in b
  Eigen::Vector3d t_ba;  ///< X_b = R_ba X_a + t_ba [m]
  Eigen::Vector3d m_a;
  double h_a;
};

/// Camera matrices [px, or scaled] of two frames a, b. They differ where the lens zooms.
struct CameraPair {
  /// Of a lens that does not. Implicit: most callers have one.
  template <typename Derived>
  CameraPair(const Eigen::MatrixBase<Derived>& K) : K_a(K), K_b(K) {}  // NOLINT(google-explicit-constructor)
  CameraPair(Eigen::Matrix3d of_a, Eigen::Matrix3d of_b) : K_a(std::move(of_a)), K_b(std::move(of_b)) {}

  Eigen::Matrix3d K_a;
  Eigen::Matrix3d K_b;
};

/// K_b (R + t m' / h) K_a^-1, h33 = 1: libs/README.md, equation (1).
Eigen::Matrix3d planeHomography(const CameraPair& cameras, const PlaneMotion& motion);

/// The translation [m] that, together with the motion's rotation and plane, gives `H` (a to b, any scale): t
/// = h (s K_b^-1 H K_a - R) m, with s from the directions within the plane, which a translation does not
/// change.
Eigen::Vector3d translationFromHomography(const CameraPair& cameras, const Eigen::Matrix3d& H,
                                          const PlaneMotion& motion);

/// Derivative of toVector(planeHomography(cameras, motion)) by a left rotation of R_ba (R <- exp(d) R) [rad],
/// by t_ba [m], by a left rotation of m_a (m <- exp(d) m) [rad], by h_a [m] and by the logarithms of the
/// focal lengths at a and at b.
struct PlaneHomographyJacobians {
  Eigen::Matrix<double, 8, 3> by_rotation;
  Eigen::Matrix<double, 8, 3> by_translation;
  Eigen::Matrix<double, 8, 3> by_normal;
  Vector8d by_height;
  Vector8d by_zoom_a;
  Vector8d by_zoom_b;
};
PlaneHomographyJacobians planeHomographyJacobians(const CameraPair& cameras, const PlaneMotion& motion);

/// Mean distance [px] between the points of a 16-px grid over the image mapped by A and by B. Points that
/// either maps to infinity or behind the camera are left out; infinity if none is left.
double meanTransferError(const Eigen::Matrix3d& A, const Eigen::Matrix3d& B, int width, int height);

}  // namespace redbee
