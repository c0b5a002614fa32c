#include "redbee/inertial/row_motion.hpp"

#include <Eigen/Geometry>

#include "redbee/inertial/homography_measurement.hpp"

namespace redbee {
namespace {

/// Rotation over a span of some milliseconds, in I [rad].
Eigen::Vector3d turnOver(const ImuSpan& span, const Eigen::Vector3d& gyro_bias) {
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();
  for (std::size_t i = 1; i < span.knots.size(); ++i) {
    const ImuSample &from = span.knots[i - 1].sample, &to = span.knots[i].sample;
    turn += seconds(to.time - from.time) * (0.5 * (from.gyro + to.gyro) - gyro_bias);
  }
  return turn;
}

}  // namespace

std::optional<RowMotion> rowMotion(const NavigationState& state, const Eigen::Vector3d& p_IC,
                                   const FrameSamples& samples, CameraTime frame, Duration half) {
  if (samples.empty()) return std::nullopt;
  const ImuTime middle = samples.imuTime(frame);
  const ImuSpan before = samples.span(middle - half, middle), after = samples.span(middle, middle + half);
  if (samples.hasGap(before) || samples.hasGap(after)) return std::nullopt;
  const double half_s = seconds(half);
  const Eigen::Vector3d turn_before = turnOver(before, state.gyro_bias);
  const Eigen::Vector3d turn_after = turnOver(after, state.gyro_bias);
  const Eigen::Vector3d rate_I = (turn_before + turn_after) / (2 * half_s);
  RowMotion motion;
  const Eigen::Matrix3d R_CI = state.cameraRotation();
  motion.rate = R_CI * rate_I + state.R_CI * state.mount.rate_M;
  motion.acceleration = R_CI * (turn_after - turn_before) / (half_s * half_s);
  motion.velocity =
      R_CI * (state.R_GI.transpose() * state.v_GI + rate_I.cross(p_IC)) / cameraHeight(state, p_IC);
  motion.normal = -(R_CI * state.R_GI.transpose()).col(2);
  return motion;
}

}  // namespace redbee
