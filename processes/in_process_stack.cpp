#include "processes/in_process_stack.hpp"

#include <chrono>
#include <utility>

#include "processes/node_factory.hpp"

namespace redbee {
namespace {

/// The stages before `end`, in processing order.
Nodes nodesBefore(const ProcessDescription* end, Bus& bus, const Configuration& configuration) {
  Nodes nodes;
  for (const ProcessDescription* stage : kStages) {
    if (stage == end) break;
    if (stage == &kImuIntegration && !configuration.expectsInertial()) continue;
    nodes.push_back(makeNode(*stage, bus, configuration));
  }
  return nodes;
}

}  // namespace

Nodes motionNodes(Bus& bus, const Configuration& configuration) {
  return nodesBefore(&kMotionSegmentation, bus, configuration);
}

bool isInput(const Channels& channels, const std::string& channel) {
  return channel == channels.camera || channel == channels.imu || channel == channels.altimeter ||
         channel == channels.gimbal || channel == channels.lens;
}

InProcessStack::InProcessStack(Bus& bus, const Configuration& configuration)
    : InProcessStack(bus, configuration.channels.health, nodesBefore(nullptr, bus, configuration)) {}

InProcessStack::InProcessStack(Bus& bus, const std::string& health_channel, Nodes nodes)
    : bus_(bus), health_channel_(health_channel), nodes_(std::move(nodes)) {}

void InProcessStack::settle() {
  do {
    for (const auto& node : nodes_) node->process();
  } while (bus_.handle(std::chrono::milliseconds(0)) > 0);
}

void InProcessStack::finish() {
  settle();
  for (const auto& node : nodes_) {
    node->finish();
    settle();
  }
}

void InProcessStack::publishHealth() {
  for (const auto& node : nodes_) bus_.publish(health_channel_, node->health().nextMessage());
  settle();
}

std::map<std::string, CpuTime> InProcessStack::cpu() const {
  std::map<std::string, CpuTime> stages;
  for (const auto& node : nodes_) stages[node->health().process()] = node->health().cpu();
  return stages;
}

}  // namespace redbee
