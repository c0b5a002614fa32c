// An image of the ground that other programs put on their maps: GeoTIFF 1.1 (OGC 19-008).
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>

#include "redbee/mosaic/georeference.hpp"
#include "redbee/mosaic/mosaic.hpp"

namespace redbee {

/// `image`: BGRA, transparent where nothing is known; its pixels lie on the map as `grid` says, and the map
/// on the projected grid `epsg` [m] as `reference` says. Throws InputError if it cannot be written.
void writeGeoTiff(const std::filesystem::path& file, const cv::Mat4b& image, const MosaicGrid& grid,
                  const Georeference& reference, int epsg);

}  // namespace redbee
