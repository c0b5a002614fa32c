// The four nodes on one bus, any of which may be killed and started again in flight time.
#pragma once

#include <array>
#include <chrono>
#include <memory>
#include <utility>
#include <vector>

#include "processes/homography_fusion/node.hpp"
#include "processes/imu_integration/node.hpp"
#include "processes/motion_segmentation/node.hpp"
#include "processes/visual_homography/node.hpp"
#include "redbee/bus/bus.hpp"

namespace redbee::test {

/// The connection of one process: cut, nothing comes or goes any more.
class Connection : public Bus {
 public:
  using Bus::publish;
  explicit Connection(Bus& bus) : bus_(bus) {}
  void publish(const std::string& channel, const std::vector<uint8_t>& data) override {
    if (!cut) bus_.publish(channel, data);
  }
  void subscribe(const std::string& channel, int capacity, Handler handler) override {
    bus_.subscribe(channel, capacity, [this, handler = std::move(handler)](const uint8_t* data, int size) {
      if (!cut) handler(data, size);
    });
  }
  int handle(std::chrono::milliseconds timeout) override { return bus_.handle(timeout); }

  bool cut = false;

 private:
  Bus& bus_;
};

struct Process {
  std::unique_ptr<Connection> connection;
  std::unique_ptr<Node> node;
};

enum Which { kImu, kVisual, kFusion, kSegmentation };

class MortalStack {
 public:
  MortalStack(Bus& bus, Configuration configuration) : bus_(bus), configuration_(std::move(configuration)) {
    for (const Which which : {kImu, kVisual, kFusion, kSegmentation}) start(which);
  }

  void kill(Which which) {
    processes_[which].connection->cut = true;
    dead_.push_back(std::move(processes_[which]));  // the bus still points into it
  }
  void start(Which which) {
    auto connection = std::make_unique<Connection>(bus_);
    auto node = make(which, *connection);
    processes_[which] = {std::move(connection), std::move(node)};
  }
  void settle() {
    do {
      for (Process& process : processes_) {
        if (process.node) process.node->process();
      }
    } while (bus_.handle(std::chrono::milliseconds(0)) > 0);
  }

 private:
  std::unique_ptr<Node> make(Which which, Bus& bus) const {
    switch (which) {
      case kImu:
        return std::make_unique<ImuIntegrationNode>(bus, configuration_);
      case kVisual:
        return std::make_unique<VisualHomographyNode>(bus, configuration_);
      case kFusion:
        return std::make_unique<HomographyFusionNode>(bus, configuration_);
      case kSegmentation:
        return std::make_unique<MotionSegmentationNode>(bus, configuration_);
    }
    return nullptr;
  }

  Bus& bus_;
  Configuration configuration_;
  std::array<Process, 4> processes_;
  std::vector<Process> dead_;
};

}  // namespace redbee::test
