// redbee calibrate: camera-IMU rotation, time shift and plane height from a recorded flight, or from a
// recording of a known target.
#pragma once

#include <filesystem>
#include <optional>

namespace redbee {

inline constexpr const char* kCalibrateName = "calibrate";
inline constexpr const char* kCalibrateDescription =
    "estimate camera-IMU rotation, time shift and height above ground from a recording";

struct CalibrateOptions {
  std::filesystem::path log;  ///< LCM log with images and IMU; or the next two
  std::filesystem::path
      target_corners;         ///< CSV of a target's corners, plain or .gz (calibration_target_csv.hpp)
  std::filesystem::path imu;  ///< CSV of the IMU, with target_corners
  std::filesystem::path configuration;  ///< the vehicle's YAML; its extrinsics are the nominal ones
  std::filesystem::path out;            ///< folder
  std::optional<double> height_m;       ///< camera above the ground at the first frame, measured by hand
  double height_sigma_m = 0.02;
  bool no_altimeter = false;  ///< leave a recorded altimeter out
  bool quiet = false;
};

/// Writes camchain-imucam.yaml, imu.yaml, calibration.yaml, verdict.json and report.html, all or none of
/// them, and prints the verdicts. Returns 0. Throws InputError or ConfigurationError on bad input and if
/// nothing can be calibrated.
int runCalibrate(const CalibrateOptions& options);

}  // namespace redbee
