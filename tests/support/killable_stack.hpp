// The nodes of the process table on one bus; each can be killed and restarted during a flight.
#pragma once

#include <chrono>
#include <map>
#include <memory>
#include <utility>

#include "processes/node_factory.hpp"
#include "redbee/bus/bus.hpp"

namespace redbee::test {

class KillableStack {
 public:
  KillableStack(Bus& bus, Configuration configuration) : bus_(bus), configuration_(std::move(configuration)) {
    for (const ProcessDescription* stage : kStages) start(*stage);
  }

  void kill(const ProcessDescription& stage) { nodes_[&stage].reset(); }
  void start(const ProcessDescription& stage) { nodes_[&stage] = makeNode(stage, bus_, configuration_); }
  void settle() {
    do {
      for (const ProcessDescription* stage : kStages) {
        if (const auto& node = nodes_[stage]) node->process();
      }
    } while (bus_.handle(std::chrono::milliseconds(0)) > 0);
  }

 private:
  Bus& bus_;
  Configuration configuration_;
  std::map<const ProcessDescription*, std::unique_ptr<Node>> nodes_;
};

}  // namespace redbee::test
