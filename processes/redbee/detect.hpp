// redbee detect: the whole stack in one process, no frame lost.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "messaging/bus.hpp"
#include "messaging/configuration.hpp"
#include "messaging/node.hpp"

namespace redbee {

/// All four nodes on one bus, worked until nothing moves any more; or a rival and what it needs.
class InProcessStack {
 public:
  InProcessStack(Bus& bus, const Configuration& configuration);
  /// `rival`: one of rivalNames(). One that wants the camera's motion gets all nodes but the segmentation
  /// where there is an IMU, since vision and fusion keep the inertial filter right.
  InProcessStack(Bus& bus, const Configuration& configuration, const std::string& rival);
  /// Hands out what waits on the bus and lets the nodes work, until there is nothing left to do.
  void settle();
  /// No message will come any more.
  void finish();
  /// Each node tells its health once.
  void publishHealth();
  /// Processor time of each node, by its name.
  std::map<std::string, CpuShare> cpu() const;

 private:
  Bus& bus_;
  std::string health_channel_;
  std::vector<std::unique_ptr<Node>> nodes_;
};

struct DetectOptions {
  std::filesystem::path log;
  std::filesystem::path configuration;
  std::filesystem::path out;
  std::string method = "redbee";      ///< one of methodNames()
  std::vector<std::string> settings;  ///< key=value, on top of all
  double rate = 0;                    ///< times the log's own speed; 0: as fast as it goes
  bool quiet = false;
};

/// "redbee": as configured; presets on top of the configuration; rivals.
std::vector<std::string> methodNames();
/// The same in one line, to be read.
std::string methodList();

/// Frames that got a mask. Throws InputError or ConfigurationError on bad input, one line each.
int64_t runDetect(const DetectOptions& options);

}  // namespace redbee
