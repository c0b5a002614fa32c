// redbee mosaic: the ground of a recorded flight as one image, with the tracks of what moved on it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace redbee {

struct MosaicOptions {
  std::filesystem::path log;
  std::filesystem::path configuration;
  std::filesystem::path out;  ///< folder
  int most_px = 3000;         ///< of a side
  int every = 2;              ///< frame is drawn; the homographies are those of all
};

struct MosaicSummary {
  int64_t frames = 0;  ///< on the map
  int64_t drawn = 0;
  size_t pieces = 0;  ///< of the flight; the longest is shown
  int width = 0;      ///< px
  int height = 0;
  double units_per_px = 0;
  bool is_metric = false;  ///< units are metres
  size_t tracks = 0;
  int epsg = 0;              ///< projected grid of mosaic.tif; 0: there is none
  double residual_m = 0;     ///< root mean square between it and the poses
  std::string why_no_place;  ///< if there is none
};

/// Writes mosaic.png (ground alone; transparent where it is unknown), mosaic.tif (the same as GeoTIFF, where
/// the log has poses with a position), tracks.png (with the tracks and their times), tracks.csv (utime,
/// identity, x, y) and, last, summary.json. Throws InputError or ConfigurationError; also
/// where no homography leads from a frame to another.
MosaicSummary makeMosaic(const MosaicOptions& options);

}  // namespace redbee
