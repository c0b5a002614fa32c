// Where the filter starts: upright by the accelerometer, its yaw free.
#pragma once

#include <optional>
#include <vector>

#include "redbee/inertial/error_state.hpp"
#include "redbee/inertial/filter_snapshot.hpp"
#include "redbee/inertial/inertial_filter.hpp"

namespace redbee {

/// The state at the frame at `utime` (camera clock). `before`: the samples of the last moments before it,
/// oldest first; not empty. Their specific force is turned into the last one's orientation by the gyro and
/// averaged. The covariance counts the drone's own acceleration (gravity_sigma) as constant over them, and
/// holds the correlation of tilt and accelerometer bias.
/// `known`: what was learned before. The sensors are the same, so biases and mounting stay with what is known
/// of them. While it is recent, so do height, vertical and velocity, and specific force only corrects the
/// vertical; later they are those of the configured start.
NavigationState initialState(int64_t utime, const std::vector<ImuSample>& before,
                             const InertialParameters& parameters,
                             const std::optional<FilterSnapshot>& known);

/// What `state`, at the frame at `utime`, holds for a filter that starts later.
FilterSnapshot snapshotOf(const NavigationState& state, int64_t utime, const Eigen::Vector3d& p_IC);

}  // namespace redbee
