// A process's inside: messages in, library call, messages out.
#pragma once

#include <atomic>
#include <filesystem>
#include <string>

#include "redbee/bus/bus.hpp"
#include "redbee/node/health.hpp"

namespace redbee {

/// A node subscribes in its constructor; its handlers only take messages in, and process() does the work. So
/// a burst of messages is seen whole before any of them is worked on.
class Node {
 public:
  virtual ~Node() = default;
  /// Works off what has arrived, as far as it can be. Called after every batch of messages.
  virtual void process() = 0;
  /// No message will come any more: works off what is left without waiting for companions.
  virtual void finish() = 0;
  virtual HealthMonitor& health() = 0;
  /// Keeps in this folder, from now on, what the process that takes its place needs. Most need nothing.
  virtual void keepStateIn(const std::filesystem::path&) {}
};

/// Live: until `stop` is set, hands out messages, lets the node work and publishes its health. An exception
/// costs a frame; only std::bad_alloc gets through.
void runNode(Bus& bus, Node& node, const std::string& health_channel, const std::atomic<bool>& stop);

/// SIGINT and SIGTERM set the flag that this returns.
const std::atomic<bool>& stopOnSignals();

}  // namespace redbee
