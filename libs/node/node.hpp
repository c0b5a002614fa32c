// A node: messages in, library call, messages out.
#pragma once

#include <atomic>
#include <filesystem>
#include <string>

#include "redbee/bus/bus.hpp"
#include "redbee/node/health.hpp"

namespace redbee {

/// A node subscribes in its constructor. Handlers only store messages; processNext() does the work, frame by
/// frame, so that all messages that have arrived are received before each.
class Node {
 public:
  virtual ~Node() = default;
  /// Processes the next frame that is ready, or skips it; false if none is ready.
  virtual bool processNext() = 0;
  /// Processes all frames that are ready.
  void process() {
    while (processNext()) {
    }
  }
  /// No more messages will arrive: processes what is left without waiting for companions.
  virtual void finish() = 0;
  virtual HealthMonitor& health() = 0;
  /// Persists in this folder what must survive a restart of the process. Most nodes have no such state.
  virtual void keepStateIn(const std::filesystem::path&) {}
};

/// The main loop of a process: until `stop` is set, dispatches messages, lets the node process a frame and
/// publishes its health. An exception costs one frame; only std::bad_alloc propagates.
void runNode(Bus& bus, Node& node, const std::string& health_channel, const std::atomic<bool>& stop);

/// Returns a flag that SIGINT and SIGTERM set.
const std::atomic<bool>& stopOnSignals();

}  // namespace redbee
