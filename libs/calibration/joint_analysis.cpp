// Covariances and goodness of fit of the joint problem, from its Jacobian in the tangent space.
#include <ceres/crs_matrix.h>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <random>
#include <utility>

#include "redbee/calibration/joint_problem.hpp"
#include "redbee/geometry/median.hpp"

namespace redbee::calibration {
namespace {

using SparseMatrix = Eigen::SparseMatrix<double>;

/// Columns of the parameters that are reported, in the order of JointProblem::orderedParameters.
struct Columns {
  static constexpr int kRotation = 0, kLeverArm = 3, kTimeshift = 6, kTilt = 7, kFirstFrame = 9,
                       kLastFrame = 18, kGyroBias = 27, kAccelBias = 30, kCount = 33;
};
/// Ceres' quaternion manifold moves a rotation by twice its tangent vector.
constexpr double kTangentToRotation = 2.0;
/// Random vectors that estimate a trace (Hutchinson 1989); the redundancies are in the thousands, and so many
/// give them to a percent.
constexpr int kProbes = 12;

SparseMatrix toEigen(const ceres::CRSMatrix& crs) {
  using RowMajor = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  const Eigen::Map<const RowMajor> rows(crs.num_rows, crs.num_cols, static_cast<int>(crs.values.size()),
                                        crs.rows.data(), crs.cols.data(), crs.values.data());
  return SparseMatrix(rows);
}

/// Degrees of freedom that remain to `rows` of the Jacobian: their number less trace(J_g A^-1 J_g'), A = J'J.
double redundancyOf(const SparseMatrix& J, const Eigen::SimplicialLDLT<SparseMatrix>& A, int begin, int rows,
                    std::mt19937& random) {
  double trace = 0;
  for (int probe = 0; probe < kProbes; ++probe) {
    Eigen::VectorXd z = Eigen::VectorXd::Zero(J.rows());
    for (int i = begin; i < begin + rows; ++i) z(i) = (random() & 1U) != 0 ? 1.0 : -1.0;
    const Eigen::VectorXd g = J.transpose() * z;
    trace += g.dot(A.solve(g)) / kProbes;
  }
  return rows - trace;
}

/// Gradient of a frame's camera height by the reported columns: h = n . (p + v s + R p_IC).
Eigen::VectorXd heightGradient(const JointState& state, const FrameState& frame, int frame_column) {
  const Eigen::Vector3d n = state.groundNormal();
  const Eigen::Vector3d arm = frame.q_GI * state.p_IC;
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(Columns::kCount);
  gradient.segment<3>(frame_column) = kTangentToRotation * arm.cross(n);
  gradient.segment<3>(frame_column + 3) = n;
  gradient.segment<3>(Columns::kLeverArm) = frame.q_GI.conjugate() * n;
  gradient(Columns::kTimeshift) = n.dot(frame.v_GI);
  gradient.segment<2>(Columns::kTilt) = (frame.p_GI + arm).head<2>();
  return gradient;
}

JointCovariance covarianceFrom(const Eigen::MatrixXd& P, const JointState& state) {
  JointCovariance covariance;
  covariance.rotation =
      kTangentToRotation * kTangentToRotation * P.block<3, 3>(Columns::kRotation, Columns::kRotation);
  covariance.p_IC = P.block<3, 3>(Columns::kLeverArm, Columns::kLeverArm);
  covariance.timeshift = P(Columns::kTimeshift, Columns::kTimeshift);
  covariance.tilt = P.block<2, 2>(Columns::kTilt, Columns::kTilt);
  covariance.gyro_bias = P.block<3, 3>(Columns::kGyroBias, Columns::kGyroBias);
  covariance.accel_bias = P.block<3, 3>(Columns::kAccelBias, Columns::kAccelBias);
  const Eigen::VectorXd first = heightGradient(state, state.frames.front(), Columns::kFirstFrame);
  const Eigen::VectorXd last = heightGradient(state, state.frames.back(), Columns::kLastFrame);
  covariance.first_height = first.dot(P * first);
  covariance.last_height = last.dot(P * last);
  return covariance;
}

}  // namespace

JointCovariance JointCovariance::scaled(double factor) const {
  JointCovariance result = *this;
  for (Eigen::Matrix3d* block : {&result.rotation, &result.p_IC, &result.gyro_bias, &result.accel_bias})
    *block *= factor;
  result.tilt *= factor;
  for (double* variance : {&result.timeshift, &result.first_height, &result.last_height}) *variance *= factor;
  return result;
}

std::vector<double*> JointProblem::orderedParameters() {
  std::vector<double*> order{state_.q_CI.coeffs().data(), state_.p_IC.data(), &state_.timeshift_step_s};
  // The target's rotation has one entry more than the tilt, so it takes the place behind the reported
  // columns.
  const bool ground = input_.target.empty();
  if (ground) order.push_back(state_.tilt.data());
  const auto addFrame = [&](FrameState& frame) {
    order.insert(order.end(), {frame.q_GI.coeffs().data(), frame.p_GI.data(), frame.v_GI.data()});
  };
  addFrame(state_.frames.front());
  addFrame(state_.frames.back());
  for (Bias& bias : state_.biases) order.insert(order.end(), {bias.gyro.data(), bias.accel.data()});
  for (size_t k = 1; k + 1 < state_.frames.size(); ++k) addFrame(state_.frames[k]);
  if (!ground) order.push_back(state_.q_GT.coeffs().data());
  return order;
}

std::vector<double> JointProblem::visionChi2() {
  std::vector<double> chi2;
  for (const ceres::ResidualBlockId block : vision_) {
    double cost = 0;
    problem_.EvaluateResidualBlock(block, false, &cost, nullptr, nullptr);
    chi2.push_back(2.0 * cost);
  }
  return chi2;
}

void JointProblem::fillGroup(GroupFit& group, const std::vector<ceres::ResidualBlockId>& blocks, int size,
                             double median) {
  std::vector<double> chi2;
  for (const ceres::ResidualBlockId block : blocks) {
    double cost = 0;
    problem_.EvaluateResidualBlock(block, false, &cost, nullptr, nullptr);
    chi2.push_back(2.0 * cost);
    group.chi2 += 2.0 * cost;
  }
  group.measurements = size * static_cast<int>(blocks.size());
  if (chi2.empty()) return;
  group.median_ratio = redbee::median(std::move(chi2)) / median;
}

JointAnalysis JointProblem::analyse() {
  JointAnalysis analysis;
  ceres::Problem::EvaluateOptions options;
  options.parameter_blocks = orderedParameters();
  for (const auto* group : {&vision_, &imu_, &others_}) {
    options.residual_blocks.insert(options.residual_blocks.end(), group->begin(), group->end());
  }
  ceres::CRSMatrix crs;
  if (!problem_.Evaluate(options, nullptr, nullptr, nullptr, &crs)) return analysis;
  const SparseMatrix J = toEigen(crs);
  const Eigen::SimplicialLDLT<SparseMatrix> A(SparseMatrix(J.transpose() * J));
  if (A.info() != Eigen::Success || (A.vectorD().array() <= 0).any()) return analysis;

  const bool ground = input_.target.empty();
  // Medians of the chi-square distributions with 8, 6 and 9 degrees of freedom.
  fillGroup(analysis.vision, vision_, ground ? 8 : 6, ground ? 7.344 : 5.348);
  fillGroup(analysis.imu, imu_, 9, 8.343);
  std::mt19937 random(1);
  analysis.vision.redundancy = redundancyOf(J, A, 0, analysis.vision.measurements, random);
  analysis.imu.redundancy =
      redundancyOf(J, A, analysis.vision.measurements, analysis.imu.measurements, random);

  // Without a ground there is no tilt; its two columns stay empty in the table of reported ones.
  const int tilt = ground ? 2 : 0;
  const int reported = Columns::kCount - 2 + tilt;
  const Eigen::MatrixXd P = A.solve(Eigen::MatrixXd::Identity(J.cols(), reported)).topRows(reported);
  Eigen::MatrixXd full = Eigen::MatrixXd::Zero(Columns::kCount, Columns::kCount);
  const int head = Columns::kTilt;
  const int tail = reported - head - tilt;
  full.topLeftCorner(head, head) = P.topLeftCorner(head, head);
  full.bottomRightCorner(tail, tail) = P.bottomRightCorner(tail, tail);
  if (ground) full = P;
  analysis.covariance = covarianceFrom(full, state_);
  analysis.valid = P.allFinite();
  return analysis;
}

}  // namespace redbee::calibration
