// Simulated inputs of the fusion.
#pragma once

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <optional>
#include <random>

#include "redbee/fusion/homography_fusion.hpp"
#include "tests/support/noisy_homography.hpp"
#include "tests/support/simulated_flight.hpp"

namespace redbee::test {

/// Homography of a shift of the whole image [px].
inline Eigen::Matrix3d translation(double x_px, double y_px = 0) {
  Eigen::Matrix3d H = Eigen::Matrix3d::Identity();
  H(0, 2) = x_px;
  H(1, 2) = y_px;
  return H;
}

/// Simulated measurements between frame numbers, with correct covariances.
class FusionInputs {
 public:
  explicit FusionInputs(unsigned seed) : flight_(seed, 8), random_(seed), scaling_(kWidth, kHeight) {}

  Eigen::Matrix3d exact(int a, int b) const { return flight_.homography(frameTime(a), frameTime(b)); }

  /// With IMU errors, in rotation and translation; the covariance differs in shape from vision's.
  InertialInput inertial(int a, int b, double rotation_sigma = 4e-4, double translation_sigma = 6e-3) {
    const PlaneMotion motion = flight_.motion(frameTime(a), frameTime(b));
    const PlaneHomographyJacobians J = planeHomographyJacobians(scaling_.T * camera().K(), motion);
    const double rotation_variance = rotation_sigma * rotation_sigma;
    const double translation_variance = translation_sigma * translation_sigma;
    const Matrix8d covariance = rotation_variance * J.by_rotation * J.by_rotation.transpose() +
                                translation_variance * J.by_translation * J.by_translation.transpose() +
                                1e-12 * Matrix8d::Identity();
    return {frameTime(a), disturbed(exact(a, b), covariance), covariance};
  }

  /// With tracking errors: pixel noise of points in the lower left quarter, extrapolated to the rest.
  VisualInput visual(int a, int b, double sigma_px = 0.4, int inliers = 300, int outliers = 100) {
    const Eigen::Matrix3d H = scaling_.scale(exact(a, b));
    Matrix8d information = Matrix8d::Zero();
    for (int v = kHeight / 2; v < kHeight; v += 32) {
      for (int u = 16; u < kWidth / 2; u += 32) {
        const auto J = transferJacobian(H, (scaling_.T * Eigen::Vector3d(u, v, 1)).head<2>());
        information += J.transpose() * J;
      }
    }
    const double sigma = sigma_px / scaling_.unit_px;
    const double ratio = 1.0 + static_cast<double>(outliers) / inliers;
    const Matrix8d inverse = information.inverse();
    const Matrix8d covariance = sigma * sigma * 0.5 * (inverse + inverse.transpose());
    // The message's covariance is that of the inliers; outliers add to it by equation 7.
    return {frameTime(a), disturbed(exact(a, b), ratio * covariance), covariance, inliers, outliers};
  }

  double error(const Eigen::Matrix3d& H, int a, int b) const {
    return meanTransferError(H, exact(a, b), kWidth, kHeight);
  }

  double normalisedErrorSquared(const FusedHomography& out, int a, int b) const {
    return test::normalisedErrorSquared(out.H_step, out.covariance_step, exact(a, b));
  }

 private:
  Eigen::Matrix3d disturbed(const Eigen::Matrix3d& H, const Matrix8d& covariance) {
    std::normal_distribution<double> normal;
    const Eigen::SelfAdjointEigenSolver<Matrix8d> axes(covariance);
    Vector8d z;
    for (int i = 0; i < 8; ++i) z(i) = std::sqrt(std::max(0.0, axes.eigenvalues()(i))) * normal(random_);
    return scaling_.unscale(fromVector(toVector(scaling_.scale(H)) + axes.eigenvectors() * z));
  }

  SimulatedFlight flight_;
  std::mt19937 random_;
  ImageScaling scaling_;
};

/// The simulated covariances are correct and need no inflation.
inline FusionParameters consistentNoise() {
  FusionParameters parameters;
  parameters.visual_inflation = 1;
  return parameters;
}

inline HomographyFusion makeFusion(const FusionParameters& parameters = consistentNoise()) {
  HomographyFusion fusion(kWidth, kHeight, parameters);
  fusion.step(frameTime(0), std::nullopt, std::nullopt);
  return fusion;
}

}  // namespace redbee::test
