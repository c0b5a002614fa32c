// Common parts of all imports: a recording becomes an LCM log, and what it states about its vehicle a
// configuration.
#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "redbee/files/log.hpp"
#include "redbee/geometry/camera.hpp"
#include "redbee/inertial/imu.hpp"

namespace redbee {

/// Names in the log; the configuration's defaults.
struct ImportChannels {
  std::string camera = "CAMERA";
  std::string imu = "IMU";
  std::string altimeter = "ALTIMETER";
};

/// What a recording states about its vehicle. The rest stays empty and is taken from the reference
/// configuration.
struct VehicleDescription {
  std::string name;
  int width = 0;   ///< px
  int height = 0;  ///< px
  std::optional<CameraIntrinsics> intrinsics;
  std::optional<Eigen::Matrix3d> R_CI;  ///< turns IMU coordinates into camera coordinates
  std::optional<Eigen::Vector3d> p_IC;  ///< m, camera centre in the IMU frame
  std::optional<ImuNoise> noise;
  bool has_imu = false;
  std::optional<AltitudeSample> start_height;  ///< altimeter at the first frame
};

struct ImportSummary {
  int64_t frames = 0;
  int64_t imu_samples = 0;
  int64_t altitudes = 0;
  int64_t first_utime = 0;  ///< us, first frame
  int64_t last_utime = 0;   ///< us, last frame
  double imu_rate_hz = 0;   ///< mean over the recording; 0 without an IMU
  VehicleDescription vehicle;
  std::vector<std::string> warnings;  ///< one line each
};

/// The sections of a vehicle configuration that the recording states (vehicle, camera, plane, imu), as YAML
/// without `include`: what it leaves out has the reference's values.
std::string vehicleYaml(const VehicleDescription& vehicle);

/// Writes vehicleYaml() beside the log: F.lcm gets F.yaml. The path written.
std::filesystem::path writeVehicleConfiguration(const VehicleDescription& vehicle,
                                                const std::filesystem::path& log);

/// For a recording without lens data: the principal point in the middle and a focal length of 0.8 of the
/// longer side (64 degrees from edge to edge, as drones and phones have), with a warning. Vision alone
/// depends on it little; with an IMU it must be right.
void assumeIntrinsics(ImportSummary& summary);

/// A line for the summary where the IMU leaves frames uncovered; nothing where it covers all of them.
std::optional<std::string> imuCoverageWarning(const std::vector<ImuSample>& imu, CameraTime first_frame,
                                              CameraTime last_frame);
double meanRate(const std::vector<ImuSample>& imu);

}  // namespace redbee
