// A folder of a flight in EuRoC's layout, imported as by `redbee import asl`.
#pragma once

#include <algorithm>
#include <filesystem>

#include "processes/redbee/vehicle/import_flight.hpp"
#include "redbee/configuration/configuration.hpp"
namespace redbee::test {

/// Writes the log and returns the vehicle's configuration.
inline Configuration importedAsl(const std::filesystem::path& folder, const std::filesystem::path& log) {
  ImportOptions options;
  options.source = folder;
  options.log = log;
  const auto asl = std::find_if(importers().begin(), importers().end(),
                                [](const Importer& importer) { return importer.name == "asl"; });
  return loadConfiguration(importFlight(*asl, options).configuration);
}

}  // namespace redbee::test
