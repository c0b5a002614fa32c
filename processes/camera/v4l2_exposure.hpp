// The exposure time that a camera of Video4Linux has now.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

namespace redbee {

/// A control's value; std::nullopt where the device does not have it.
using ControlReader = std::function<std::optional<int32_t>(int device, uint32_t control)>;
std::optional<int32_t> readV4l2Control(int device, uint32_t control);

/// s; std::nullopt where the driver does not tell it. `device`: of a camera that is open.
std::optional<double> v4l2Exposure(int device, const ControlReader& read = readV4l2Control);

}  // namespace redbee
