// What a filter returns to where an observation of an earlier frame arrives.
#pragma once

#include <optional>

#include "redbee/geometry/time.hpp"
#include "redbee/inertial/corrections.hpp"
#include "redbee/inertial/error_state.hpp"
#include "redbee/inertial/filter_snapshot.hpp"

namespace redbee {

/// The state at a frame before vision corrects it.
struct FilterCheckpoint {
  CameraTime previous_frame;
  CameraTime frame;
  NavigationState state;
  AltitudeCorrection altitude;
  VisionCorrection vision;
  std::optional<FilterSnapshot> known;
};

}  // namespace redbee
