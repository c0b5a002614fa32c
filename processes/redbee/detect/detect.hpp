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
  double rate = 0;                    ///< replay speed relative to real time; 0: as fast as possible
  bool quiet = false;
};

/// "redbee": as configured; presets and detectors on top of the configuration.
std::vector<std::string> methodNames();
/// The same, comma-separated.
std::string methodList();

/// The whole stack; for a detector that does not need the camera's motion, only the segmentation.
InProcessStack makeStack(Bus& bus, const Configuration& configuration);

/// Returns the number of frames with a mask. Throws InputError or ConfigurationError on bad input; also where
/// no frame has a mask to trust, after the results are written.
int64_t runDetect(const DetectOptions& options);

}  // namespace redbee
