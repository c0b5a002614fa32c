// The nodes of the process table on one bus; each can be killed and restarted during a flight.
#pragma once

#include <chrono>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include "processes/node_factory.hpp"
#include "redbee/bus/bus.hpp"

namespace redbee::test {

class KillableStack {
 public:
  KillableStack(Bus& bus, Configuration configuration) : bus_(bus), configuration_(std::move(configuration)) {
    for (const ProcessDescription* stage : kStages) start(*stage);
  }

  void kill(const ProcessDescription& stage) {
    nodes_[&stage].reset();
    hanging_.erase(&stage);
  }
  /// It receives messages and does nothing, until it is killed.
  void hang(const ProcessDescription& stage) { hanging_.insert(&stage); }
  void start(const ProcessDescription& stage) { nodes_[&stage] = makeNode(stage, bus_, configuration_); }
  void settle() {
    do {
      for (const ProcessDescription* stage : kStages) {
        if (const auto& node = nodes_[stage]; node && hanging_.count(stage) == 0) node->process();
      }
    } while (bus_.handle(std::chrono::milliseconds(0)) > 0);
  }
  /// No more messages will arrive.
  void finish() {
    for (const ProcessDescription* stage : kStages) {
      if (const auto& node = nodes_[stage]; node && hanging_.count(stage) == 0) node->finish();
      settle();
    }
  }

 private:
  Bus& bus_;
  Configuration configuration_;
  std::map<const ProcessDescription*, std::unique_ptr<Node>> nodes_;
  std::set<const ProcessDescription*> hanging_;
};

}  // namespace redbee::test
