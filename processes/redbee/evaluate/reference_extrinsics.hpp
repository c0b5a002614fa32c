// redbee reference-extrinsics: writes a configuration with a rendered clip's true extrinsics plus the error
// of a good calibration.
#pragma once

#include <filesystem>
#include <string>

#include "redbee/evaluation/extrinsics_disturbance.hpp"
#include "redbee/inertial/imu.hpp"

namespace redbee {

struct ReferenceExtrinsicsOptions {
  std::filesystem::path flight;         ///< folder with groundtruth.yaml and labels/camera_pose.csv
  std::filesystem::path configuration;  ///< of the vehicle, included by the file written
  std::filesystem::path out;            ///< the YAML file to write
  std::string seed;                     ///< empty: the flight folder's name
  ExtrinsicsDisturbance disturbance;
};

/// T_BS_cam0_true and time_offset_s of groundtruth.yaml; the height of the first frame in camera_pose.csv.
/// Throws InputError.
InertialExtrinsics readTrueExtrinsics(const std::filesystem::path& flight);

void writeReferenceExtrinsics(const ReferenceExtrinsicsOptions& options);

}  // namespace redbee
