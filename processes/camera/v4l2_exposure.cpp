#include "processes/camera/v4l2_exposure.hpp"

#include <linux/videodev2.h>
#include <sys/ioctl.h>

namespace redbee {

std::optional<int32_t> readV4l2Control(int device, uint32_t control) {
  v4l2_control value{};
  value.id = control;
  if (ioctl(device, VIDIOC_G_CTRL, &value) != 0) return std::nullopt;
  return value.value;
}

std::optional<double> v4l2Exposure(int device, const ControlReader& read) {
  constexpr double kUnit_s = 1e-4;  // of V4L2_CID_EXPOSURE_ABSOLUTE
  constexpr double kLongest_s = 1;  // no camera in motion is exposed for longer
  const auto value = device < 0 ? std::nullopt : read(device, V4L2_CID_EXPOSURE_ABSOLUTE);
  if (!value || *value <= 0 || *value * kUnit_s > kLongest_s) return std::nullopt;
  return *value * kUnit_s;
}

}  // namespace redbee
