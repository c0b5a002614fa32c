// redbee import kalibr: Kalibr's calibration becomes a vehicle's configuration, as `redbee calibrate` writes
// it for Kalibr.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace redbee {

struct KalibrImport {
  std::filesystem::path camchain;            ///< camchain.yaml or camchain-imucam.yaml
  std::string camera = "cam0";               ///< its section
  std::optional<std::filesystem::path> imu;  ///< imu.yaml
  std::filesystem::path out;                 ///< the vehicle's configuration
};

/// Writes the configuration, of the camera and, with `imu`, of the IMU. Returns warnings, one line each.
/// Throws InputError or ConfigurationError with file and line, also where `out` exists or a value is out of
/// bounds; then nothing is written.
std::vector<std::string> importKalibr(const KalibrImport& options);

}  // namespace redbee
