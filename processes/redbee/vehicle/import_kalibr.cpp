#include "processes/redbee/vehicle/import_kalibr.hpp"

#include <cmath>

#include "processes/redbee/vehicle/vehicle_file.hpp"
#include "redbee/configuration/configuration.hpp"
#include "redbee/files/atomic_file.hpp"
#include "redbee/files/input_error.hpp"
#include "redbee/importers/sensor_yaml.hpp"

namespace redbee {
namespace {

// Of a time shift and of a camera's place on a vehicle; what is beyond is of another unit or sign.
constexpr double kMostTimeshift_s = 0.5;
constexpr double kMostLever_m = 5;

VehicleDescription vehicleOf(const CamchainCamera& camera, const KalibrImport& options) {
  VehicleDescription vehicle;
  vehicle.name = options.out.stem().string();
  vehicle.width = camera.intrinsics.width;
  vehicle.height = camera.intrinsics.height;
  vehicle.intrinsics = camera.intrinsics;
  vehicle.R_CI = camera.R_CI;
  vehicle.p_IC = camera.p_IC;
  vehicle.timeshift_s = camera.timeshift_s;
  vehicle.has_imu = options.imu.has_value();
  if (options.imu) vehicle.noise = readKalibrImu(*options.imu);
  return vehicle;
}

void requirePlausible(const VehicleDescription& vehicle, const std::filesystem::path& file) {
  const double shift = vehicle.timeshift_s.value_or(0);
  if (!(std::abs(shift) <= kMostTimeshift_s))
    throw InputError(file,
                     "timeshift_cam_imu: " + std::to_string(shift) + " s is none of a camera beside an IMU");
  if (vehicle.p_IC && !(vehicle.p_IC->norm() <= kMostLever_m)) {
    throw InputError(file, "T_cam_imu: the camera is " + std::to_string(vehicle.p_IC->norm()) +
                               " m from the IMU: is its translation in m?");
  }
}

/// "FILE:LINE: what" without the file, which the user never sees.
std::string withoutPlace(const std::string& line, const std::filesystem::path& file) {
  if (line.rfind(file.string() + ":", 0) != 0) return line;
  const size_t what = line.find(": ", file.string().size());
  return what == std::string::npos ? line : line.substr(what + 2);
}

std::vector<std::string> warningsOf(const VehicleDescription& vehicle, const KalibrImport& options) {
  std::vector<std::string> warnings;
  if (vehicle.R_CI && !options.imu)
    warnings.push_back("no --imu-noise: imu.present is false, and T_cam_imu is kept for when it is true");
  if (!vehicle.R_CI && options.imu) {
    warnings.push_back(options.camchain.string() +
                       ": has no T_cam_imu: camera.R_CI is the reference's; give camchain-imucam.yaml");
  }
  return warnings;
}

}  // namespace

std::vector<std::string> importKalibr(const KalibrImport& options) {
  if (std::filesystem::exists(options.out))
    throw InputError(options.out, "exists: move it away, or give --out another name");
  const VehicleDescription vehicle = vehicleOf(readCamchain(options.camchain, options.camera), options);
  requirePlausible(vehicle, options.camchain);
  const std::string from = options.camchain.string() + (options.imu ? " and " + options.imu->string() : "");
  writeAtomically(options.out, "# From Kalibr's " + from + "; all else has the reference's values.\n" +
                                   vehicleYaml(vehicle));
  try {
    loadConfiguration(options.out);
  } catch (const UserError& error) {
    std::filesystem::remove(options.out);
    throw InputError(from + ": gives no vehicle: " + withoutPlace(error.what(), options.out));
  }
  return warningsOf(vehicle, options);
}

}  // namespace redbee
