// The nodes of the process table on one bus, any of which may be killed and started again in flight time.
#pragma once

#include <chrono>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "processes/node_factory.hpp"
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

class KillableStack {
 public:
  KillableStack(Bus& bus, Configuration configuration) : bus_(bus), configuration_(std::move(configuration)) {
    for (const ProcessDescription* stage : kStages) start(*stage);
  }

  void kill(const ProcessDescription& stage) {
    Process& process = processes_[&stage];
    process.connection->cut = true;
    dead_.push_back(std::move(process));  // the bus still points into it
  }
  void start(const ProcessDescription& stage) {
    auto connection = std::make_unique<Connection>(bus_);
    auto node = makeNode(stage, *connection, configuration_);
    processes_[&stage] = {std::move(connection), std::move(node)};
  }
  void settle() {
    do {
      for (const ProcessDescription* stage : kStages) {
        const Process& process = processes_[stage];
        if (process.node) process.node->process();
      }
    } while (bus_.handle(std::chrono::milliseconds(0)) > 0);
  }

 private:
  Bus& bus_;
  Configuration configuration_;
  std::map<const ProcessDescription*, Process> processes_;
  std::vector<Process> dead_;
};

}  // namespace redbee::test
