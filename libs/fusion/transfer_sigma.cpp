#include "redbee/fusion/transfer_sigma.hpp"

#include <cmath>

namespace redbee {

double transferSigma(const Eigen::Matrix3d& H, const Matrix8d& covariance, int width, int height) {
  constexpr int kSteps = 4;
  const ImageScaling scaling(width, height);
  double sum = 0;
  for (int row = 0; row <= kSteps; ++row) {
    for (int column = 0; column <= kSteps; ++column) {
      const Eigen::Vector3d pixel(column * (width - 1.0) / kSteps, row * (height - 1.0) / kSteps, 1);
      const auto J = transferJacobian(H, (scaling.T * pixel).head<2>());
      sum += transferCovariance(J, covariance).trace();
    }
  }
  return scaling.unit_px * std::sqrt(sum / ((kSteps + 1) * (kSteps + 1)));
}

}  // namespace redbee
