#include "processes/redbee/vehicle/vehicle_file.hpp"

#include <vector>

#include "redbee/configuration/configuration.hpp"
#include "redbee/files/atomic_file.hpp"
#include "redbee/files/input_error.hpp"

namespace redbee {
namespace {

using Keys = std::vector<std::string>;

void append(Keys& keys, const Keys& more) { keys.insert(keys.end(), more.begin(), more.end()); }

void setCamera(const VehicleDescription& vehicle, Configuration& configuration, Keys& keys) {
  append(keys, {"camera.width", "camera.height"});
  if (vehicle.intrinsics) {
    configuration.camera = *vehicle.intrinsics;
    append(keys, {"camera.fx", "camera.fy", "camera.cx", "camera.cy", "camera.model", "camera.distortion"});
  }
  if (configuration.camera.line_delay_s != 0) append(keys, {"camera.line_delay_s"});
  configuration.camera.width = vehicle.width;
  configuration.camera.height = vehicle.height;
  InertialExtrinsics& extrinsics = configuration.inertial.extrinsics;
  if (vehicle.R_CI) {
    extrinsics.R_CI = *vehicle.R_CI;
    append(keys, {"camera.R_CI"});
  }
  if (vehicle.p_IC) {
    extrinsics.p_IC = *vehicle.p_IC;
    append(keys, {"camera.p_IC"});
  }
  if (vehicle.timeshift_s) {
    extrinsics.timeshift_s = *vehicle.timeshift_s;
    append(keys, {"camera.timeshift_s"});
  }
}

}  // namespace

std::string vehicleYaml(const VehicleDescription& vehicle) {
  Configuration configuration;
  Keys keys{"vehicle", "imu.present"};
  configuration.vehicle = vehicle.name;
  configuration.has_imu = vehicle.has_imu;
  setCamera(vehicle, configuration, keys);
  if (vehicle.mount_sigma_deg) {
    configuration.inertial.gimbal.enabled = true;
    configuration.inertial.gimbal.angle_sigma_deg = *vehicle.mount_sigma_deg;
    append(keys, {"gimbal.enabled", "gimbal.angle_sigma_deg"});
  }
  if (vehicle.lens_focal_px) {
    configuration.inertial.lens.enabled = true;
    configuration.inertial.lens.focal_length_px = *vehicle.lens_focal_px;
    configuration.inertial.lens.on_camera_clock = true;  // it says what the lens did in each image
    append(keys, {"lens.enabled", "lens.focal_length_px", "lens.on_camera_clock"});
  }
  if (vehicle.start_height) {
    configuration.inertial.extrinsics.start_height_m = vehicle.start_height->height_m;
    configuration.inertial.extrinsics.start_height_sigma_m = vehicle.start_height->sigma_m;
    append(keys, {"plane.height_m", "plane.height_sigma_m"});
  }
  if (vehicle.noise) {
    configuration.inertial.noise = *vehicle.noise;
    append(keys, {"imu.gyro_noise_density", "imu.accel_noise_density", "imu.gyro_random_walk",
                  "imu.accel_random_walk"});
  }
  const std::string preset = vehicle.has_imu ? "" : "preset: vision_only\n";
  return preset + emitYaml(configuration, keys);
}

std::filesystem::path writeVehicleFile(const VehicleDescription& vehicle, const std::filesystem::path& log) {
  std::filesystem::path path = log;
  path.replace_extension(".yaml");
  writeAtomically(path,
                  "# What the recording states about its vehicle; all else has the reference's values.\n" +
                      vehicleYaml(vehicle));
  return path;
}

std::string compareVehicleFile(const std::filesystem::path& file, const VehicleDescription& vehicle) {
  const Configuration configuration = loadConfiguration(file);
  const auto size = [](int width, int height) {
    return std::to_string(width) + "x" + std::to_string(height);
  };
  const CameraIntrinsics& camera = configuration.camera;
  if (camera.width != vehicle.width || camera.height != vehicle.height) {
    throw InputError(file, "is of another camera: its images have " + size(camera.width, camera.height) +
                               " px, the recording's " + size(vehicle.width, vehicle.height) +
                               ": move it away, or give --out another name");
  }
  if (configuration.has_imu == vehicle.has_imu) return "";
  return file.string() + ": imu.present is " + (configuration.has_imu ? "true" : "false") +
         ", but the recording has " + (vehicle.has_imu ? "an" : "no") +
         " IMU: correct it, or move it away and import again";
}

}  // namespace redbee
