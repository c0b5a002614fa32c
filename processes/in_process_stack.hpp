// Nodes in one process, worked until nothing moves any more: for redbee detect and for tests.
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

/// What finds the camera's motion: all nodes but the segmentation. Without an IMU vision and fusion.
Nodes motionNodes(Bus& bus, const Configuration& configuration);

class InProcessStack {
 public:
  /// The stack that flies.
  InProcessStack(Bus& bus, const Configuration& configuration);
  /// `nodes`: on `bus`, which hears of their health on `health_channel`.
  InProcessStack(Bus& bus, const std::string& health_channel, Nodes nodes);
  /// Hands out what waits on the bus and lets the nodes work, until there is nothing left to do.
  void settle();
  /// No message will come any more.
  void finish();
  /// Each node tells its health once.
  void publishHealth();
  /// Processor time of each node, by its name.
  std::map<std::string, CpuTime> cpu() const;

 private:
  Bus& bus_;
  std::string health_channel_;
  Nodes nodes_;
};

}  // namespace redbee
