// Automatic derivatives against numeric ones, and zero residuals at the truth.
#include <ceres/autodiff_cost_function.h>
#include <ceres/gradient_checker.h>
#include <ceres/manifold.h>
#include <gtest/gtest.h>

#include <memory>

#include "redbee/calibration/altitude_cost.hpp"
#include "redbee/calibration/ground_homography_cost.hpp"
#include "redbee/calibration/preintegration_cost.hpp"
#include "redbee/calibration/prior_costs.hpp"
#include "redbee/calibration/target_pose_cost.hpp"
#include "redbee/geometry/so3.hpp"

namespace redbee::calibration {
namespace {

const double q_a[] = {0.1, -0.2, 0.3, std::sqrt(1 - 0.14)};
const double q_b[] = {0.12, -0.17, 0.33, std::sqrt(1 - 0.12 * 0.12 - 0.17 * 0.17 - 0.33 * 0.33)};
const double q_CI[] = {0.5, -0.5, 0.5, -0.5};
const double p_a[] = {0.3, -0.2, 5.0};
const double p_b[] = {0.4, -0.1, 5.1};
const double v_a[] = {1.0, 0.4, -0.2};
const double v_b[] = {1.1, 0.3, -0.1};
const double p_IC[] = {0.05, -0.03, 0.02};
const double shift[] = {0.003};
const double tilt[] = {0.02, -0.01};
const double gyro_bias[] = {0.01, -0.02, 0.005};
const double accel_bias[] = {0.1, -0.05, 0.02};

template <typename Cost, int... Sizes>
void expectDerivatives(Cost cost, std::vector<const double*> parameters) {
  const ceres::AutoDiffCostFunction<Cost, Cost::kResiduals, Sizes...> function(new Cost(std::move(cost)));
  const ceres::EigenQuaternionManifold quaternion;
  std::vector<const ceres::Manifold*> manifolds;
  for (const int size : {Sizes...}) manifolds.push_back(size == 4 ? &quaternion : nullptr);
  ceres::NumericDiffOptions options;
  options.relative_step_size = 1e-6;
  ceres::GradientChecker checker(&function, &manifolds, options);
  ceres::GradientChecker::ProbeResults results;
  EXPECT_TRUE(checker.Probe(parameters.data(), 1e-6, &results)) << results.error_log;
}

GroundHomographyCost groundCost() {
  GroundHomographyCost cost;
  cost.K_scaled << 1.5, 0, 0.01, 0, 1.5, -0.02, 0, 0, 1;
  cost.K_scaled_inverse = cost.K_scaled.inverse();
  cost.measured << 1, 0.01, 0.02, -0.01, 1, 0.03, 0.001, -0.002;
  cost.square_root = Matrix8d::Identity() + 0.1 * Matrix8d::Ones();
  cost.rate_a = {0.3, -0.4, 0.2};
  cost.rate_b = {0.1, -0.5, 0.3};
  return cost;
}

PreintegrationCost imuCost() {
  PreintegrationCost cost;
  cost.sum.dt_s = 0.04;
  cost.sum.R = expSO3({0.02, 0.05, 0.04});
  cost.sum.v = {0.1, -0.2, 0.39};
  cost.sum.p = {0.002, -0.004, 0.008};
  cost.sum.R_by_gyro = -0.04 * expSO3({0.1, 0.0, 0.1});
  cost.sum.v_by_gyro = 0.01 * expSO3({0.3, 0.1, 0.1});
  cost.sum.v_by_accel = -0.04 * expSO3({0.1, 0.2, 0.1});
  cost.sum.p_by_gyro = 0.001 * expSO3({0.3, 0.1, 0.1});
  cost.sum.p_by_accel = -0.0008 * expSO3({0.1, 0.2, 0.1});
  cost.square_root = Matrix9d::Identity() + 0.1 * Matrix9d::Ones();
  cost.gravity = 9.81;
  return cost;
}

TEST(CostFunctions, GroundHomographyDerivativesAgreeWithNumericOnes) {
  expectDerivatives<GroundHomographyCost, 4, 3, 3, 4, 3, 3, 4, 3, 1, 2>(
      groundCost(), {q_a, p_a, v_a, q_b, p_b, v_b, q_CI, p_IC, shift, tilt});
}

TEST(CostFunctions, PreintegrationDerivativesAgreeWithNumericOnes) {
  expectDerivatives<PreintegrationCost, 4, 3, 3, 4, 3, 3, 3, 3>(
      imuCost(), {q_a, p_a, v_a, q_b, p_b, v_b, gyro_bias, accel_bias});
}

TEST(CostFunctions, AltitudeDerivativesAgreeWithNumericOnes) {
  expectDerivatives<AltitudeCost, 4, 3, 3, 3, 2>({5.1, 0.05, 0.012}, {q_a, p_a, v_a, p_IC, tilt});
}

TEST(CostFunctions, TargetPoseDerivativesAgreeWithNumericOnes) {
  TargetPoseCost cost;
  cost.q_CT = Eigen::Quaterniond(expSO3({0.3, 0.2, -0.1}));
  cost.p_CT = {0.1, 0.2, 1.5};
  cost.square_root = Matrix6d::Identity() + 0.1 * Matrix6d::Ones();
  cost.rate = {0.3, -0.4, 0.2};
  expectDerivatives<TargetPoseCost, 4, 3, 3, 4, 3, 1, 4>(cost, {q_a, p_a, v_a, q_CI, p_IC, shift, q_b});
}

TEST(CostFunctions, PriorDerivativesAgreeWithNumericOnes) {
  const Eigen::Quaterniond expected(expSO3({0.3, 0.2, -0.1}));
  expectDerivatives<RotationPriorCost, 4>({expected, 0.1}, {q_a});
  expectDerivatives<YawGaugeCost, 4>({expected, 0.1}, {q_a});
  expectDerivatives<VectorPriorCost<2>, 3>({Eigen::Vector2d::Zero(), 0.1}, {p_a});
  expectDerivatives<BiasWalkCost, 3, 3>({0.1}, {gyro_bias, accel_bias});
}

TEST(CostFunctions, GroundHomographyResidualVanishesForThePlanesOwnHomography) {
  GroundHomographyCost cost = groundCost();
  const CameraAt<double> a = cameraAt(q_a, p_a, v_a, cost.rate_a, q_CI, p_IC, shift[0]);
  const CameraAt<double> b = cameraAt(q_b, p_b, v_b, cost.rate_b, q_CI, p_IC, shift[0]);
  const Eigen::Vector3d n = groundNormal(tilt);
  // Points of the plane n . X = 0 in both cameras define the homography without its formula.
  Eigen::Matrix3d plane_a, plane_b;
  const Eigen::Vector3d along = n.cross(Eigen::Vector3d::UnitX()).normalized(), across = n.cross(along);
  const Eigen::Vector3d foot = a.p_GC - n.dot(a.p_GC) * n;
  plane_a << a.q_CG * along, a.q_CG * across, a.q_CG * Eigen::Vector3d(foot - a.p_GC);
  plane_b << b.q_CG * along, b.q_CG * across, b.q_CG * Eigen::Vector3d(foot - b.p_GC);
  cost.measured = toVector(cost.K_scaled * plane_b * plane_a.inverse() * cost.K_scaled_inverse);
  Vector8d residual;
  ASSERT_TRUE(cost(q_a, p_a, v_a, q_b, p_b, v_b, q_CI, p_IC, shift, tilt, residual.data()));
  EXPECT_LT(residual.cwiseAbs().maxCoeff(), 1e-10);
}

TEST(CostFunctions, GroundHomographyRefusesACameraBelowTheGround) {
  const double below[] = {0, 0, -1};
  Vector8d residual;
  EXPECT_FALSE(groundCost()(q_a, below, v_a, q_b, p_b, v_b, q_CI, p_IC, shift, tilt, residual.data()));
}

}  // namespace
}  // namespace redbee::calibration
