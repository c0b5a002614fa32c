// Where the filter starts: upright by the accelerometer, its yaw free, its velocity unknown.
#pragma once

#include <vector>

#include "inertial/error_state.hpp"
#include "inertial/inertial_filter.hpp"

namespace redbee {

/// `before`: the samples of the last moments before the first frame, oldest first; not empty. Their specific
/// force is turned into the last one's orientation by the gyro and averaged. The covariance counts the
/// drone's own acceleration (gravity_sigma) as constant over them, and holds the correlation of tilt and
/// accelerometer bias.
NavigationState initialState(const std::vector<ImuSample>& before, const InertialParameters& parameters);

/// Restart of a filter that ran before: the sensors are the same, so biases and mounting stay with what is
/// known of them.
NavigationState restartedState(const NavigationState& old, const std::vector<ImuSample>& before,
                               const InertialParameters& parameters);

}  // namespace redbee
