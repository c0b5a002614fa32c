// EuRoC's folder layout (ASL): DIR/mav0/{cam0,imu0,altimeter0}/{data.csv,sensor.yaml}.
#pragma once

#include <filesystem>

#include "redbee/files/progress.hpp"
#include "redbee/importers/image_file.hpp"
#include "redbee/importers/import.hpp"

namespace redbee {

struct AslImportOptions {
  std::filesystem::path folder;  ///< the one that holds mav0, or mav0 itself
  std::filesystem::path log;     ///< to be written
  ImportChannels channels;
  ImageOptions images;
};

/// Camera stamps stay on the camera's clock and IMU stamps on the IMU's, as the folder has them; ns become us
/// by rounding to the nearest. imu0 and altimeter0 may be absent, cam0 not. Throws InputError, and then there
/// is no log.
ImportSummary importAsl(const AslImportOptions& options, Progress& progress);

}  // namespace redbee
