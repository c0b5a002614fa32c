// redbee simulate: a flight with exact ground truth, as a log and a configuration.
#pragma once

#include <filesystem>
#include <string>

namespace redbee {

struct SimulateOptions {
  std::string scenario = "two_planes";
  unsigned seed = 1;
  double seconds = 5;
  double readout_ms = 0;        ///< of a rolling shutter; 0: global shutter
  std::filesystem::path log;    ///< its configuration goes beside it
  std::filesystem::path truth;  ///< masks and homography.csv; empty: none
};

/// Comma-separated.
std::string scenarioNames();

/// Throws InputError on an unknown scenario or a file that cannot be written.
void runSimulate(const SimulateOptions& options);

}  // namespace redbee
