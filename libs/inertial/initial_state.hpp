// The filter's initial state: roll and pitch from the accelerometer, yaw free.
#pragma once

#include <optional>
#include <vector>

#include "redbee/geometry/time.hpp"
#include "redbee/inertial/error_state.hpp"
#include "redbee/inertial/filter_snapshot.hpp"
#include "redbee/inertial/inertial_filter.hpp"

namespace redbee {

/// The state at the frame at `time`. `before`: the samples just before it, oldest first; not empty. Their
/// specific force is rotated into the last one's orientation by the gyro and averaged. The covariance treats
/// the drone's own acceleration (gravity_sigma) as constant over them, and includes the correlation of tilt
/// and accelerometer bias. `known`: an earlier snapshot, from which biases and mounting are taken; if it is
/// recent, height, vertical and velocity as well, and specific force only corrects the vertical. Otherwise
/// the configured values are used.
NavigationState initialState(CameraTime time, const std::vector<ImuSample>& before,
                             const InertialParameters& parameters,
                             const std::optional<FilterSnapshot>& known);

/// Snapshot of `state` at the frame at `time`, for the warm start of another filter.
FilterSnapshot snapshotOf(const NavigationState& state, CameraTime time, const Eigen::Vector3d& p_IC);

}  // namespace redbee
