// redbee record: records all channels into split logs, until it is stopped or the disk is nearly full.
#pragma once

#include <filesystem>
#include <string>

namespace redbee {

struct RecordOptions {
  std::string url;
  std::string channel = "PROCESS_HEALTH";  ///< channel of its own health
  std::filesystem::path out = "out/recordings";
  double split_mb = 512;
  double min_free_mb = 1024;  ///< disk space to leave free
};

/// Unlike lcm-logger, which queues at most 30 messages and so loses some if it is not scheduled for some 10
/// ms, and which drops unwritten messages when it is stopped. Returns true after SIGINT or SIGTERM, when
/// everything sent before is written; false if the disk is full or failed.
bool runRecord(const RecordOptions& options);

}  // namespace redbee
