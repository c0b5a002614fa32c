// redbee detect: the whole stack over a recorded flight, in one process, without losing a frame.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "processes/in_process_stack.hpp"

namespace redbee {

struct DetectOptions {
  std::filesystem::path log;
  std::filesystem::path configuration;
  std::filesystem::path out;
  std::string method = "redbee";      ///< one of methodNames()
  std::vector<std::string> settings;  ///< key=value, on top of all
  int64_t frames = 0;                 ///< only the first frames of the log; 0: all
  double rate = 0;                    ///< times the log's own speed; 0: as fast as it goes
  bool quiet = false;
};

/// "redbee": as configured; presets and detectors on top of the configuration.
std::vector<std::string> methodNames();
/// The same in one line, separated by commas.
std::string methodList();

/// The stack that flies; for a detector that does not need the camera's motion, that detector alone.
InProcessStack makeStack(Bus& bus, const Configuration& configuration);

/// Frames that got a mask. Throws InputError or ConfigurationError on bad input, one line each.
int64_t runDetect(const DetectOptions& options);

}  // namespace redbee
