// Motion of the camera while a rolling shutter's image is read out.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "redbee/geometry/rolling_shutter.hpp"
#include "redbee/inertial/error_state.hpp"
#include "redbee/inertial/frame_samples.hpp"

namespace redbee {

/// `state`: at the frame; `half`: of the read-out's duration, above 0. Rate and acceleration are those that
/// turn the camera as far in each half as the gyro does. std::nullopt where samples are missing.
std::optional<RowMotion> rowMotion(const NavigationState& state, const Eigen::Vector3d& p_IC,
                                   const FrameSamples& samples, CameraTime frame, Duration half);

}  // namespace redbee
