// redbee record: every message of every channel, into split logs, until it is told to stop or the disk is
// nearly full.
#pragma once

#include <filesystem>
#include <string>

namespace redbee {

struct RecordOptions {
  std::string url;
  std::string channel = "PROCESS_HEALTH";  ///< where it says how it fares
  std::filesystem::path out = "out/recordings";
  double split_mb = 512;
  double min_free_mb = 1024;  ///< of the disk, left to others
};

/// lcm-logger would do, but for two things: no more than 30 messages wait for it, so that it loses some
/// whenever it gets no processor for some hundredths of a second, and it drops what it has not written when
/// it is told to stop. Returns after SIGINT or SIGTERM, everything sent before them written: true; false
/// where the disk ended it.
bool runRecord(const RecordOptions& options);

}  // namespace redbee
