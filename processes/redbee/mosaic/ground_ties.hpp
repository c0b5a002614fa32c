// Ties between the mosaic's map and the earth, from the recorded poses.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "redbee/configuration/configuration.hpp"
#include "redbee/geometry/camera.hpp"
#include "redbee/mosaic/georeference.hpp"
#include "redbee/mosaic/mosaic.hpp"

namespace redbee {

/// Places are metres east and north on the grid of UTM, or of UPS near the poles.
struct GroundTies {
  std::vector<GroundTie> ties;
  int epsg = 0;           ///< of that grid, on WGS-84
  std::string why_empty;  ///< if there are no ties: what is missing
};

/// From POSE, GIMBAL and ALTIMETER of the log, at the times of the frames on the map.
GroundTies readGroundTies(const std::filesystem::path& log, const Configuration& configuration,
                          const Camera& camera, const GroundFrames& frames, const MosaicGrid& grid);

}  // namespace redbee
