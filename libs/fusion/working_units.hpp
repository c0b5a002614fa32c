// Units in which the fusion's filter works.
#pragma once

#include "redbee/fusion/fusion_parameters.hpp"
#include "redbee/geometry/homography.hpp"

namespace redbee {

/// The paper's filter works in pixels: its Q and P_0 are diagonal in these units only.
inline ImageScaling workingUnits(const ImageScaling& scaled, FusionNoise noise) {
  ImageScaling units = scaled;
  if (noise == FusionNoise::kPaper) {
    units.T.setIdentity();
    units.T_inverse.setIdentity();
    units.unit_px = 1;
  }
  return units;
}

}  // namespace redbee
