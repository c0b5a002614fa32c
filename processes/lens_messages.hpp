// What LENS says of the focal length, against the configured one.
#pragma once

#include <optional>

#include "redbee/configuration/configuration.hpp"
#include "redbee/inertial/lens_track.hpp"
#include "redbee/lens_t.hpp"

namespace redbee {

/// std::nullopt where the message does not give the focal length.
inline std::optional<LensSample> lensSampleOf(const lens_t& message, const Configuration& configuration) {
  const CameraIntrinsics& camera = configuration.camera;
  StatedZoom stated;
  if (message.has_focal_length != 0) stated.focal_px = message.focal_length * camera.width / message.width;
  if (message.has_zoom != 0) stated.range = message.zoom;
  const std::optional<double> zoom = zoomOf(stated, camera.fx, configuration.inertial.lens);
  if (!zoom) return std::nullopt;
  return LensSample{ImuTime(fromUtime(message.utime)), *zoom};
}

}  // namespace redbee
