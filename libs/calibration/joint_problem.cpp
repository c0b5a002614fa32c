#include "redbee/calibration/joint_problem.hpp"

#include <ceres/autodiff_cost_function.h>
#include <ceres/loss_function.h>
#include <ceres/manifold.h>
#include <ceres/solver.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "redbee/calibration/altitude_cost.hpp"
#include "redbee/calibration/ground_homography_cost.hpp"
#include "redbee/calibration/preintegration_cost.hpp"
#include "redbee/calibration/prior_costs.hpp"
#include "redbee/geometry/so3.hpp"

namespace redbee::calibration {
namespace {

/// Half of the stretch around an exposure that its angular rate is averaged over: longer than the period of a
/// propeller's vibration.
constexpr double kRateReach_s = 0.006;
/// Scale of the Cauchy loss on a whole homography or pose: a measurement that follows the model (chi2 about
/// 8) keeps 90 % of its weight.
constexpr double kVisionLoss = 8.0;
constexpr double kGaugeYaw_rad = 1e-4;
constexpr double kGaugePlace_m = 1e-3;

template <typename Cost, int... Sizes>
ceres::CostFunction* automatic(Cost cost) {
  return new ceres::AutoDiffCostFunction<Cost, Cost::kResiduals, Sizes...>(new Cost(std::move(cost)));
}

/// L' with L L' = M, for a positive definite M.
template <int N>
Eigen::Matrix<double, N, N> squareRoot(const Eigen::Matrix<double, N, N>& M) {
  return M.llt().matrixL().transpose();
}

double* data(Eigen::Quaterniond& q) { return q.coeffs().data(); }

ceres::Manifold* quaternionManifold() { return new ceres::EigenQuaternionManifold(); }

}  // namespace

JointProblem::JointProblem(const JointInput& input, JointState& state) : input_(input), state_(state) {
  addFrames();
  addImu();
  if (input.target.empty()) {
    addGround();
    addHeights();
  } else {
    addTarget();
  }
  addPriors();
}

Eigen::Vector3d JointProblem::rateAt(const FrameState& frame) const {
  const double t = frame.t_cam_s + state_.timeshift_s;
  const Bias& bias = state_.biases[state_.biasIndex(frame.t_cam_s)];
  return input_.imu->meanRate(t - kRateReach_s, t + kRateReach_s) - bias.gyro;
}

void JointProblem::addFrames() {
  for (FrameState& frame : state_.frames) {
    problem_.AddParameterBlock(data(frame.q_GI), 4, quaternionManifold());
    problem_.AddParameterBlock(frame.p_GI.data(), 3);
    problem_.AddParameterBlock(frame.v_GI.data(), 3);
  }
  problem_.AddParameterBlock(data(state_.q_CI), 4, quaternionManifold());
}

void JointProblem::addImu() {
  for (size_t k = 0; k + 1 < state_.frames.size(); ++k) {
    FrameState& a = state_.frames[k];
    FrameState& b = state_.frames[k + 1];
    Bias& bias = state_.biases[state_.biasIndex(a.t_cam_s)];
    PreintegrationCost cost;
    cost.sum = preintegrate(*input_.imu, a.t_cam_s + state_.timeshift_s, b.t_cam_s + state_.timeshift_s, bias,
                            input_.noise);
    cost.square_root = squareRoot<9>((cost.sum.covariance * input_.imu_variance_scale).inverse());
    cost.gravity = input_.gravity;
    imu_.push_back(problem_.AddResidualBlock(
        automatic<PreintegrationCost, 4, 3, 3, 4, 3, 3, 3, 3>(cost), nullptr, data(a.q_GI), a.p_GI.data(),
        a.v_GI.data(), data(b.q_GI), b.p_GI.data(), b.v_GI.data(), bias.gyro.data(), bias.accel.data()));
  }
  for (size_t i = 0; i + 1 < state_.biases.size(); ++i) {
    const double root = std::sqrt(state_.bias_begin_s[i + 1] - state_.bias_begin_s[i]);
    const BiasWalkCost gyro{std::max(input_.noise.gyro_random_walk * root, 1e-9)};
    const BiasWalkCost accel{std::max(input_.noise.accel_random_walk * root, 1e-8)};
    Bias& here = state_.biases[i];
    Bias& next = state_.biases[i + 1];
    others_.push_back(problem_.AddResidualBlock(automatic<BiasWalkCost, 3, 3>(gyro), nullptr,
                                                here.gyro.data(), next.gyro.data()));
    others_.push_back(problem_.AddResidualBlock(automatic<BiasWalkCost, 3, 3>(accel), nullptr,
                                                here.accel.data(), next.accel.data()));
  }
}

void JointProblem::addGround() {
  const CameraIntrinsics& size = input_.camera->ideal();
  const ImageScaling scaling(size.width, size.height);
  const Eigen::Matrix3d K_scaled = scaling.T * input_.camera->K();
  for (const GroundHomography& measured : input_.ground) {
    FrameState& a = state_.frames[measured.a];
    FrameState& b = state_.frames[measured.b];
    GroundHomographyCost cost;
    cost.K_scaled = K_scaled;
    cost.K_scaled_inverse = K_scaled.inverse();
    cost.measured = toVector(scaling.scale(measured.H));
    cost.square_root = squareRoot<8>(measured.information / input_.vision_variance_scale);
    cost.rate_a = rateAt(a);
    cost.rate_b = rateAt(b);
    vision_.push_back(problem_.AddResidualBlock(
        automatic<GroundHomographyCost, 4, 3, 3, 4, 3, 3, 4, 3, 1, 2>(cost),
        new ceres::CauchyLoss(kVisionLoss), data(a.q_GI), a.p_GI.data(), a.v_GI.data(), data(b.q_GI),
        b.p_GI.data(), b.v_GI.data(), data(state_.q_CI), state_.p_IC.data(), &state_.timeshift_step_s,
        state_.tilt.data()));
  }
}

void JointProblem::addTarget() {
  problem_.AddParameterBlock(data(state_.q_GT), 4, quaternionManifold());
  for (const TargetPose& measured : input_.target) {
    FrameState& frame = state_.frames[measured.frame];
    const TargetPoseCost cost{measured.q_CT, measured.p_CT,
                              squareRoot<6>(measured.information / input_.vision_variance_scale),
                              rateAt(frame)};
    vision_.push_back(problem_.AddResidualBlock(
        automatic<TargetPoseCost, 4, 3, 3, 4, 3, 1, 4>(cost), new ceres::CauchyLoss(kVisionLoss),
        data(frame.q_GI), frame.p_GI.data(), frame.v_GI.data(), data(state_.q_CI), state_.p_IC.data(),
        &state_.timeshift_step_s, data(state_.q_GT)));
  }
}

void JointProblem::addHeights() {
  const auto imuTime = [&](const FrameState& frame) { return frame.t_cam_s + state_.timeshift_s; };
  for (const HeightObservation& height : input_.heights) {
    auto nearest = std::lower_bound(state_.frames.begin(), state_.frames.end(), height.t_imu_s,
                                    [&](const FrameState& frame, double t) { return imuTime(frame) < t; });
    if (nearest == state_.frames.end()) continue;
    if (nearest != state_.frames.begin() &&
        height.t_imu_s - imuTime(*(nearest - 1)) < imuTime(*nearest) - height.t_imu_s) {
      --nearest;
    }
    const double tau = height.t_imu_s - imuTime(*nearest);
    constexpr double kMaxTau_s = 0.05;
    if (std::abs(tau) > kMaxTau_s) continue;
    const AltitudeCost cost{height.height_m, height.sigma_m, tau};
    others_.push_back(problem_.AddResidualBlock(
        automatic<AltitudeCost, 4, 3, 3, 3, 2>(cost), new ceres::HuberLoss(3.0), data(nearest->q_GI),
        nearest->p_GI.data(), nearest->v_GI.data(), state_.p_IC.data(), state_.tilt.data()));
  }
}

void JointProblem::addPriors() {
  const JointPriors& priors = input_.priors;
  const auto add = [&](ceres::CostFunction* cost, double* parameter) {
    others_.push_back(problem_.AddResidualBlock(cost, nullptr, parameter));
  };
  add(automatic<RotationPriorCost, 4>({priors.q_CI, priors.rotation_sigma_rad}), data(state_.q_CI));
  add(automatic<VectorPriorCost<3>, 3>({priors.p_IC, priors.p_IC_sigma_m}), state_.p_IC.data());
  const Eigen::Matrix<double, 1, 1> step(priors.timeshift_s - state_.timeshift_s);
  add(automatic<VectorPriorCost<1>, 1>({step, priors.timeshift_sigma_s}), &state_.timeshift_step_s);
  add(automatic<VectorPriorCost<3>, 3>({Eigen::Vector3d::Zero(), priors.gyro_bias_sigma}),
      state_.biases.front().gyro.data());
  add(automatic<VectorPriorCost<3>, 3>({Eigen::Vector3d::Zero(), priors.accel_bias_sigma}),
      state_.biases.front().accel.data());
  if (!input_.target.empty()) {
    add(automatic<YawGaugeCost, 4>({state_.q_GT, kGaugeYaw_rad}), data(state_.q_GT));
    return;
  }
  FrameState& first = state_.frames.front();
  add(automatic<VectorPriorCost<2>, 2>({Eigen::Vector2d::Zero(), priors.tilt_sigma_rad}), state_.tilt.data());
  add(automatic<YawGaugeCost, 4>({first.q_GI, kGaugeYaw_rad}), data(first.q_GI));
  // The horizontal position is unobservable as well.
  add(automatic<VectorPriorCost<2>, 3>({Eigen::Vector2d::Zero(), kGaugePlace_m}), first.p_GI.data());
  const AltitudeCost height{priors.height_m, priors.height_sigma_m, 0.0};
  others_.push_back(problem_.AddResidualBlock(automatic<AltitudeCost, 4, 3, 3, 3, 2>(height), nullptr,
                                              data(first.q_GI), first.p_GI.data(), first.v_GI.data(),
                                              state_.p_IC.data(), state_.tilt.data()));
}

bool JointProblem::solve() {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.max_num_iterations = 60;
  options.num_threads = 2;
  // Nearly Gauss-Newton: hardly observable directions would converge slowly under a smaller radius.
  options.initial_trust_region_radius = 1e8;
  options.function_tolerance = 1e-7;
  options.parameter_tolerance = 1e-10;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem_, &summary);
  report_ = summary.BriefReport();
  return summary.IsSolutionUsable();
}

double cameraHeight(const JointState& state, size_t frame) {
  const FrameState& f = state.frames[frame];
  return state.groundNormal().dot(f.p_GI + f.q_GI * state.p_IC);
}

void absorbTimeshiftStep(JointState& state, const JointInput& input) {
  const double step = state.timeshift_step_s;
  for (FrameState& frame : state.frames) {
    const double t = frame.t_cam_s + state.timeshift_s;
    const Bias& bias = state.biases[state.biasIndex(frame.t_cam_s)];
    const Eigen::Vector3d rate = input.imu->meanRate(t - kRateReach_s, t + kRateReach_s) - bias.gyro;
    frame.q_GI = (frame.q_GI * Eigen::Quaterniond(expSO3(rate * step))).normalized();
    frame.p_GI += frame.v_GI * step;
  }
  state.timeshift_s += step;
  state.timeshift_step_s = 0;
}

PlaneMotion predictedMotion(const JointState& state, size_t a, size_t b) {
  const auto R_CG = [&](const FrameState& f) { return (state.q_CI * f.q_GI.conjugate()).toRotationMatrix(); };
  const auto p_GC = [&](const FrameState& f) -> Eigen::Vector3d { return f.p_GI + f.q_GI * state.p_IC; };
  const FrameState& fa = state.frames[a];
  const FrameState& fb = state.frames[b];
  const Eigen::Vector3d n = state.groundNormal();
  return {R_CG(fb) * R_CG(fa).transpose(), R_CG(fb) * (p_GC(fa) - p_GC(fb)), -R_CG(fa) * n, n.dot(p_GC(fa))};
}

Eigen::Matrix3d predictedHomography(const JointState& state, const JointInput& input, size_t a, size_t b) {
  return planeHomography(input.camera->K(), predictedMotion(state, a, b));
}

}  // namespace redbee::calibration
