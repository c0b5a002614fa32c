// Any video that ffmpeg reads, or a folder of images, with or without an IMU.
#pragma once

#include <filesystem>
#include <vector>

#include "redbee/importers/importer.hpp"

namespace redbee {

/// Source: a file, or a folder of JPEGs or PNGs taken in the order of their names. Frames have their
/// presentation times.
Importer videoImporter();

/// The file of ImportOptions::imu.
std::vector<ImuSample> readImuCsv(const std::filesystem::path& file);

}  // namespace redbee
