// Writes the vehicle file of an imported recording beside its log.
#pragma once

#include <filesystem>
#include <string>

#include "redbee/importers/import.hpp"

namespace redbee {

/// The keys of a vehicle's configuration that the recording states (vehicle, camera, plane, imu); all others
/// have the reference configuration's values.
std::string vehicleYaml(const VehicleDescription& vehicle);

/// Writes vehicleYaml() beside the log (F.yaml for F.lcm). Returns the path.
std::filesystem::path writeVehicleFile(const VehicleDescription& vehicle, const std::filesystem::path& log);

/// Compares a vehicle's configuration that was there before with what the recording states. Throws InputError
/// if it has another image size, so that every image would be ignored, or ConfigurationError if it cannot be
/// read; returns a line if it says of the IMU what the recording contradicts, otherwise an empty one.
std::string compareVehicleFile(const std::filesystem::path& file, const VehicleDescription& vehicle);

}  // namespace redbee
