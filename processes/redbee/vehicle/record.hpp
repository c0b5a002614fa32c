// redbee record: writes every message of every channel into split logs, until it is stopped or the disk is
// nearly full.
#pragma once

#include <filesystem>
#include <string>

namespace redbee {

struct RecordOptions {
  std::string url;
  std::string channel = "PROCESS_HEALTH";  ///< channel of its own health
  std::filesystem::path out = "out/recordings";
  double split_mb = 512;
  double min_free_mb = 1024;  ///< disk space left to others
};

/// Two differences to lcm-logger: that one queues at most 30 messages, and so loses some whenever it is not
/// scheduled for some hundredths of a second; and it drops what it has not written when it is stopped.
/// Returns true after SIGINT or SIGTERM, with everything sent before them written; false if the disk ended
/// it.
bool runRecord(const RecordOptions& options);

}  // namespace redbee
