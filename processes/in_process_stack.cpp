#include "processes/in_process_stack.hpp"

#include <chrono>
#include <utility>

#include "processes/homography_fusion/node.hpp"
#include "processes/imu_integration/node.hpp"
#include "processes/motion_segmentation/node.hpp"
#include "processes/visual_homography/node.hpp"

namespace redbee {
namespace {

Nodes allNodes(Bus& bus, const Configuration& configuration) {
  Nodes nodes = motionNodes(bus, configuration);
  nodes.push_back(std::make_unique<MotionSegmentationNode>(bus, configuration));
  return nodes;
}

}  // namespace

Nodes motionNodes(Bus& bus, const Configuration& configuration) {
  Nodes nodes;
  if (configuration.has_imu) nodes.push_back(std::make_unique<ImuIntegrationNode>(bus, configuration));
  nodes.push_back(std::make_unique<VisualHomographyNode>(bus, configuration));
  nodes.push_back(std::make_unique<HomographyFusionNode>(bus, configuration));
  return nodes;
}

InProcessStack::InProcessStack(Bus& bus, const Configuration& configuration)
    : InProcessStack(bus, configuration.channels.health, allNodes(bus, configuration)) {}

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
