#include "processes/redbee/vehicle/import_flight.hpp"

#include <cstdio>
#include <string>

#include "processes/redbee/vehicle/vehicle_file.hpp"
#include "processes/warnings.hpp"
#include "redbee/files/progress.hpp"
#include "redbee/files/user_error.hpp"
#include "redbee/geometry/time.hpp"

namespace redbee {
namespace {

/// A log beside a configuration that does not fit it would be of no use.
std::string comparedWith(const std::filesystem::path& configuration, const ImportSummary& summary,
                         const std::filesystem::path& log) {
  try {
    return compareVehicleFile(configuration, summary.vehicle);
  } catch (const UserError&) {
    std::filesystem::remove(log);
    throw;
  }
}

}  // namespace

ImportedFlight importFlight(const Importer& importer, const ImportOptions& options) {
  Progress progress("importing " + options.source.string(), "frames");
  ImportedFlight flight;
  flight.summary = importRecording(importer, options, progress);
  flight.configuration = options.log;
  flight.configuration.replace_extension(".yaml");
  flight.is_new = !std::filesystem::exists(flight.configuration);
  if (flight.is_new) {
    writeVehicleFile(flight.summary.vehicle, options.log);
  } else if (const std::string line = comparedWith(flight.configuration, flight.summary, options.log);
             !line.empty()) {
    flight.summary.warnings.push_back(line);
  }
  printWarnings(flight.summary.warnings);
  return flight;
}

void printFlight(const ImportedFlight& flight, const std::filesystem::path& log) {
  const ImportSummary& summary = flight.summary;
  std::printf("%s: %lld frames of %dx%d in %.3f s, %lld IMU samples (%.1f Hz), %lld altitudes\n", log.c_str(),
              static_cast<long long>(summary.frames), summary.vehicle.width, summary.vehicle.height,
              seconds(fromUtime(summary.last_utime - summary.first_utime)),
              static_cast<long long>(summary.imu_samples), summary.imu_rate_hz,
              static_cast<long long>(summary.altitudes));
  std::printf(flight.is_new ? "%s: the vehicle as the recording describes it; check it before use\n"
                            : "%s: exists and is left as it is\n",
              flight.configuration.c_str());
}

}  // namespace redbee
