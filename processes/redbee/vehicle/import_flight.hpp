// redbee import: a recording becomes a log with the vehicle's configuration beside it.
#pragma once

#include <filesystem>

#include "redbee/importers/importer.hpp"

namespace redbee {

struct ImportedFlight {
  ImportSummary summary;
  std::filesystem::path configuration;  ///< F.yaml beside F.lcm
  bool is_new = false;                  ///< otherwise it was there before, and is left as it is
};

/// Imports, and writes the vehicle's configuration unless there is one; prints the warnings to stderr. Throws
/// InputError or ConfigurationError, also for an earlier configuration that does not fit
/// (compareVehicleFile()); then there is no log.
ImportedFlight importFlight(const Importer& importer, const ImportOptions& options);

/// One line on stdout.
void printFlight(const ImportedFlight& flight, const std::filesystem::path& log);

}  // namespace redbee
