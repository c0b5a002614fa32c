// redbee detect: the whole stack in one process, no frame lost.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "messaging/bus.hpp"
#include "messaging/configuration.hpp"
#include "messaging/node.hpp"

namespace redbee {

/// All four nodes on one bus, worked until nothing moves any more.
class InProcessStack {
 public:
  InProcessStack(Bus& bus, const Configuration& configuration);
  /// Hands out what waits on the bus and lets the nodes work, until there is nothing left to do.
  void settle();
  /// No message will come any more.
  void finish();
  /// Each node tells its health once.
  void publishHealth();

 private:
  Bus& bus_;
  std::string health_channel_;
  std::vector<std::unique_ptr<Node>> nodes_;
};

struct DetectOptions {
  std::filesystem::path log;
  std::filesystem::path configuration;
  std::filesystem::path out;
  std::string method = "redbee";      ///< "redbee": as configured; else a preset on top of the configuration
  std::vector<std::string> settings;  ///< key=value, on top of all
  double rate = 0;                    ///< times the log's own speed; 0: as fast as it goes
  bool quiet = false;
};

/// Frames that got a mask. Throws InputError or ConfigurationError on bad input, one line each.
int64_t runDetect(const DetectOptions& options);

}  // namespace redbee
