// Conversions between messages and the libraries' types. What arrives is plausible
// (libs/node/message_check.hpp).
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "redbee/earlier_step_t.hpp"
#include "redbee/filter_snapshot_t.hpp"
#include "redbee/geometry/homography.hpp"
#include "redbee/geometry/rolling_shutter.hpp"
#include "redbee/geometry/row_major.hpp"
#include "redbee/geometry/time.hpp"
#include "redbee/homography_t.hpp"
#include "redbee/inertial/filter_snapshot.hpp"
#include "redbee/inertial_homography_t.hpp"
#include "redbee/node/frame_time.hpp"
#include "redbee/plane_motion_t.hpp"
#include "redbee/row_motion_t.hpp"
#include "redbee/tracks_t.hpp"
#include "redbee/visual/point_tracker.hpp"
#include "redbee/visual_homography_t.hpp"

namespace redbee {

using RowMajor8d = Eigen::Matrix<double, 8, 8, Eigen::RowMajor>;

inline Eigen::Matrix3d matrix3(const double (&entries)[9]) { return Eigen::Map<const RowMajor3d>(entries); }
inline Eigen::Matrix<double, 8, 8> matrix8(const double (&entries)[64]) {
  return Eigen::Map<const RowMajor8d>(entries);
}
inline Eigen::Vector3d vector3(const double (&entries)[3]) {
  return Eigen::Map<const Eigen::Vector3d>(entries);
}

inline void fill(double (&entries)[9], const Eigen::Matrix3d& M) {
  Eigen::Map<RowMajor3d> rows(entries);
  rows = M;
}
inline void fill(double (&entries)[64], const Eigen::Matrix<double, 8, 8>& M) {
  Eigen::Map<RowMajor8d> rows(entries);
  rows = M;
}
inline void fill(double (&entries)[3], const Eigen::Vector3d& v) {
  Eigen::Map<Eigen::Vector3d> rows(entries);
  rows = v;
}
inline void fill(double (&entries)[8], const Eigen::Matrix<double, 8, 1>& v) {
  Eigen::Map<Eigen::Matrix<double, 8, 1>> rows(entries);
  rows = v;
}

inline void fill(double (&entries)[2], const Eigen::Vector2d& v) {
  entries[0] = v.x();
  entries[1] = v.y();
}
inline void fill(double (&entries)[4], const Eigen::Matrix2d& M) {
  entries[0] = M(0, 0);
  entries[1] = M(0, 1);
  entries[2] = M(1, 0);
  entries[3] = M(1, 1);
}

inline filter_snapshot_t messageOf(const FilterSnapshot& snapshot, const std::string& configuration) {
  filter_snapshot_t message{};
  message.utime = toUtime(snapshot.time);
  message.configuration = configuration;
  message.height = snapshot.height_m;
  message.height_sigma = snapshot.height_sigma_m;
  fill(message.up, snapshot.up);
  fill(message.up_sigma, snapshot.up_sigma);
  fill(message.velocity, snapshot.velocity);
  fill(message.velocity_sigma, snapshot.velocity_sigma);
  fill(message.gyro_bias, snapshot.gyro_bias);
  fill(message.gyro_bias_sigma, snapshot.gyro_bias_sigma);
  fill(message.accel_bias, snapshot.accel_bias);
  fill(message.accel_bias_sigma, snapshot.accel_bias_sigma);
  fill(message.R_CI, snapshot.R_CI);
  fill(message.R_CI_sigma, snapshot.R_CI_sigma);
  return message;
}

inline FilterSnapshot snapshotOf(const filter_snapshot_t& message) {
  FilterSnapshot snapshot;
  snapshot.time = timeOf(message);
  snapshot.height_m = message.height;
  snapshot.height_sigma_m = message.height_sigma;
  snapshot.up = vector3(message.up);
  snapshot.up_sigma = vector3(message.up_sigma);
  snapshot.velocity = vector3(message.velocity);
  snapshot.velocity_sigma = vector3(message.velocity_sigma);
  snapshot.gyro_bias = vector3(message.gyro_bias);
  snapshot.gyro_bias_sigma = vector3(message.gyro_bias_sigma);
  snapshot.accel_bias = vector3(message.accel_bias);
  snapshot.accel_bias_sigma = vector3(message.accel_bias_sigma);
  snapshot.R_CI = matrix3(message.R_CI);
  snapshot.R_CI_sigma = vector3(message.R_CI_sigma);
  return snapshot;
}

/// `tracks.inlier` is all 0 where `inlier` is empty.
inline void fill(tracks_t& message, const PointTracks& tracks, const std::vector<uint8_t>& inlier = {}) {
  const size_t n = tracks.current.size();
  message.n = static_cast<int32_t>(n);
  for (auto* array : {&message.x_previous, &message.y_previous, &message.x, &message.y}) array->resize(n);
  for (size_t i = 0; i < n; ++i) {
    message.x_previous[i] = tracks.previous[i].x;
    message.y_previous[i] = tracks.previous[i].y;
    message.x[i] = tracks.current[i].x;
    message.y[i] = tracks.current[i].y;
  }
  message.inlier = inlier;
  message.inlier.resize(n);
}

inline PointTracks tracksOf(const tracks_t& message) {
  PointTracks tracks;
  tracks.previous.reserve(message.x.size());
  tracks.current.reserve(message.x.size());
  for (size_t i = 0; i < message.x.size(); ++i) {
    tracks.previous.emplace_back(message.x_previous[i], message.y_previous[i]);
    tracks.current.emplace_back(message.x[i], message.y[i]);
  }
  return tracks;
}

inline PlaneMotion motionOf(const plane_motion_t& message) {
  return {matrix3(message.R), vector3(message.t), vector3(message.normal), message.distance};
}
inline void fill(plane_motion_t& message, const PlaneMotion& motion) {
  fill(message.R, motion.R_ba);
  fill(message.t, motion.t_ba);
  fill(message.normal, motion.m_a);
  message.distance = motion.h_a;
}

inline std::optional<RowMotion> rowMotionOf(const row_motion_t& message) {
  if (message.valid == 0) return std::nullopt;
  return RowMotion{vector3(message.rate), vector3(message.acceleration), vector3(message.velocity),
                   vector3(message.normal)};
}
inline void fill(row_motion_t& message, const std::optional<RowMotion>& motion) {
  message.valid = motion ? 1 : 0;
  if (!motion) return;
  fill(message.rate, motion->rate);
  fill(message.acceleration, motion->acceleration);
  fill(message.velocity, motion->velocity);
  fill(message.normal, motion->normal);
}

/// Of any message that has it: 1, the configured focal length, where it is not known.
template <typename Message>
double zoomOf(const Message& message) {
  return message.zoom > 0 ? message.zoom : 1;
}

inline void fill(homography_t& message, const Eigen::Matrix3d& H,
                 const Eigen::Matrix<double, 8, 8>& covariance) {
  fill(message.H, H);
  fill(message.covariance, covariance);
}

/// What the next message repeats of this one, which is about the frame at `time`.
template <typename Message>
earlier_step_t stepOf(const Message& message, CameraTime time, bool is_valid) {
  earlier_step_t step{};
  step.valid = is_valid ? 1 : 0;
  step.utime = toUtime(time);
  step.utime_previous = message.utime_previous;
  step.ground = message.ground;
  step.zoom = message.zoom;
  if constexpr (std::is_same_v<Message, visual_homography_t>) {
    step.inliers = message.inliers;
    step.outliers = message.outliers;
  }
  return step;
}

/// The message about the frame before, as far as `message` repeats it.
template <typename Message>
std::optional<Message> restoredFrom(const Message& message) {
  const earlier_step_t& earlier = message.earlier;
  const bool is_before = earlier.utime_previous < earlier.utime && earlier.utime < message.utime;
  if (earlier.valid == 0 || !is_before) return std::nullopt;
  Message restored{};
  restored.utime = earlier.utime;
  restored.utime_previous = earlier.utime_previous;
  restored.width = message.width;
  restored.height = message.height;
  restored.ground = earlier.ground;
  restored.zoom = earlier.zoom;
  return restored;
}
inline std::optional<visual_homography_t> restoredVisual(const visual_homography_t& message) {
  auto restored = restoredFrom(message);
  if (!restored) return std::nullopt;
  restored->status = visual_homography_t::GOOD;
  restored->inliers = message.earlier.inliers;
  restored->outliers = message.earlier.outliers;
  return restored;
}
inline std::optional<inertial_homography_t> restoredInertial(const inertial_homography_t& message) {
  auto restored = restoredFrom(message);
  if (restored) restored->valid = 1;
  return restored;
}

}  // namespace redbee
