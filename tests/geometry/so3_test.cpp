#include "redbee/geometry/so3.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "tests/support/numeric_jacobian.hpp"

namespace redbee::test {
namespace {

TEST(Rotation, ExpAndLogAreInversesForSmallAndLargeAngles) {
  for (const double angle : {0.0, 1e-9, 1e-5, 0.1, 1.5, 3.1}) {
    const Eigen::Vector3d phi = angle * Eigen::Vector3d(1, -2, 0.5).normalized();
    EXPECT_LT((logSO3(expSO3(phi)) - phi).norm(), 1e-9) << angle;
    EXPECT_TRUE(isRotation(expSO3(phi), 1e-12));
  }
}

TEST(Rotation, ExpAgreesWithEigen) {
  const Eigen::Vector3d phi(0.3, -0.2, 0.9);
  const Eigen::Matrix3d expected = Eigen::AngleAxisd(phi.norm(), phi.normalized()).toRotationMatrix();
  EXPECT_LT((expSO3(phi) - expected).norm(), 1e-14);
}

TEST(Rotation, RightJacobianMatchesDifferences) {
  const Eigen::Vector3d phi(0.3, -0.2, 0.9);
  const auto numeric = numericJacobian<3, 3>(
      [&](const Eigen::Vector3d& d) { return logSO3(expSO3(phi).transpose() * expSO3(phi + d)); });
  EXPECT_LT((rightJacobianSO3(phi) - numeric).norm(), 1e-8);
}

TEST(Rotation, NearestRotationUndoesANonRigidDisturbance) {
  const Eigen::Matrix3d R = expSO3({0.3, -0.2, 0.9});
  EXPECT_LT((nearestRotation(1.7 * R) - R).norm(), 1e-12);
  EXPECT_FALSE(isRotation(1.001 * R));
  EXPECT_FALSE(isRotation(-R));
}

}  // namespace
}  // namespace redbee::test
