// All nodes in one process, which run until no message is left: for redbee detect and for tests.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "redbee/bus/bus.hpp"
#include "redbee/configuration/configuration.hpp"
#include "redbee/node/node.hpp"

namespace redbee {

using Nodes = std::vector<std::unique_ptr<Node>>;

/// The stages that estimate the camera's motion, before the segmentation; without an IMU only vision and
/// fusion.
Nodes motionNodes(Bus& bus, const Configuration& configuration);

/// Whether messages of this channel go into the stack: what a replay feeds it of a log.
bool isInput(const Channels& channels, const std::string& channel);

class InProcessStack {
 public:
  /// All stages of the process table.
  InProcessStack(Bus& bus, const Configuration& configuration);
  /// `nodes`: on `bus`. Their health is published on `health_channel`.
  InProcessStack(Bus& bus, const std::string& health_channel, Nodes nodes);
  /// Delivers messages and runs the nodes until no message is left.
  void settle();
  /// No more messages will arrive.
  void finish();
  /// Each node publishes its health once.
  void publishHealth();
  /// Processor time of each node, by its name.
  std::map<std::string, CpuTime> cpu() const;

 private:
  Bus& bus_;
  std::string health_channel_;
  Nodes nodes_;
};

}  // namespace redbee
