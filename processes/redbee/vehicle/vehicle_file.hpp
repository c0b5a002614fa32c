// The vehicle file that an import writes beside the log.
#pragma once

#include <filesystem>
#include <string>

#include "redbee/importers/import.hpp"

namespace redbee {

/// The keys of a vehicle's configuration that the recording states (vehicle, camera, plane, imu): what it
/// leaves out has the reference's values.
std::string vehicleYaml(const VehicleDescription& vehicle);

/// Writes vehicleYaml() beside the log: F.lcm gets F.yaml. The path written.
std::filesystem::path writeVehicleFile(const VehicleDescription& vehicle, const std::filesystem::path& log);

}  // namespace redbee
