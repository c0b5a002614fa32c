// From the time that a driver stamps an image with to the middle of its exposure.
#pragma once

#include "redbee/configuration/configuration.hpp"
#include "redbee/geometry/time.hpp"

namespace redbee {

/// To the exposure's middle in the middle row, from what capture.stamp says the stamp is; `exposure_s`: of
/// each row.
inline Duration toExposureMiddle(const CaptureParameters& capture, const CameraIntrinsics& camera,
                                 double exposure_s) {
  const double half_s = (exposure_s + camera.line_delay_s * (camera.height - 1)) / 2;
  if (capture.stamp == "exposure_start") return fromSeconds(half_s);
  if (capture.stamp == "readout_end") return -fromSeconds(half_s);
  return Duration(0);
}

}  // namespace redbee
