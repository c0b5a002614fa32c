// A node: messages in, library call, messages out.
#pragma once

#include <atomic>
#include <filesystem>
#include <string>

#include "redbee/bus/bus.hpp"
#include "redbee/node/health.hpp"

namespace redbee {

/// A node subscribes in its constructor. Handlers only store messages; process() does the work, so that all
/// messages of a burst are received before the first one is processed.
class Node {
 public:
  virtual ~Node() = default;
  /// Processes what is ready. Called after every batch of messages.
  virtual void process() = 0;
  /// No more messages will arrive: processes what is left without waiting for companions.
  virtual void finish() = 0;
  virtual HealthMonitor& health() = 0;
  /// Persists in this folder what must survive a restart of the process. Most nodes have no such state.
  virtual void keepStateIn(const std::filesystem::path&) {}
};

/// The main loop of a process: until `stop` is set, dispatches messages, lets the node process them and
/// publishes its health. An exception costs one frame; only std::bad_alloc propagates.
void runNode(Bus& bus, Node& node, const std::string& health_channel, const std::atomic<bool>& stop);

/// Returns a flag that SIGINT and SIGTERM set.
const std::atomic<bool>& stopOnSignals();

}  // namespace redbee
