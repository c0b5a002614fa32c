#include "redbee/inertial/rotation_difference.hpp"

#include <Eigen/LU>

#include "redbee/geometry/products.hpp"
#include "redbee/geometry/small_decompositions.hpp"
#include "redbee/inertial/homography_measurement.hpp"

namespace redbee {

std::optional<RotationDifference> rotationDifference(const CameraPair& cameras, const PlaneMotion& motion,
                                                     const Eigen::Matrix3d& rotation_covariance,
                                                     const Eigen::Matrix3d& normal_covariance,
                                                     const Vector8d& observed,
                                                     const Matrix8d& observed_covariance) {
  const PlaneHomographyJacobians by = planeHomographyJacobians(cameras, motion);
  const Matrix8d noise = observed_covariance + mappedCovariance(by.by_normal, normal_covariance);
  const LdltFactors factors(noise);
  if (!factors.succeeded() || !factors.isPositive()) return std::nullopt;
  const Vector8d innovation = observed - toVector(planeHomography(cameras, motion));

  // Weighted least squares for rotation and translation; the translation is eliminated.
  const Matrix8d W = factors.inverse();
  const Eigen::Matrix<double, 3, 8> Wr = product(W, by.by_rotation).transpose();
  const Eigen::Matrix<double, 3, 8> Wt = product(W, by.by_translation).transpose();
  const Eigen::Matrix3d by_translation = Eigen::Matrix3d(Wr * by.by_translation) *
                                         Eigen::Matrix3d(Eigen::Matrix3d(Wt * by.by_translation).inverse());
  const Eigen::Matrix<double, 3, 8> Wr_free = Wr - by_translation * Wt;
  const Eigen::Matrix3d covariance = Eigen::Matrix3d(Wr_free * by.by_rotation).inverse();
  RotationDifference result;
  result.difference = covariance * (Wr_free * innovation);
  result.covariance = 0.5 * (covariance + covariance.transpose()) + rotation_covariance;
  if (!result.difference.allFinite() || !result.covariance.allFinite()) return std::nullopt;
  return result;
}

std::optional<RotationDifference> rotationDifference(const NavigationState& state, const Camera& camera,
                                                     const Eigen::Vector3d& p_IC, const Eigen::Matrix3d& H,
                                                     const Matrix8d& covariance) {
  const PlaneMotion motion = cameraMotion(state, p_IC);
  const MotionJacobians J = motionJacobians(state, motion, p_IC);
  const ImageScaling scaling(camera.ideal().width, camera.ideal().height);
  const CameraPair cameras = scaledMatrices(state, camera);
  const Matrix8d by_zoom = zoomCovariance(state, planeHomographyJacobians(cameras, motion));
  return rotationDifference(cameras, motion, rotationCovariance(state, J), normalCovariance(state, J),
                            toVector(scaling.scale(H)), covariance + by_zoom);
}

}  // namespace redbee
