#include "redbee/node/node.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <functional>
#include <new>
#include <opencv2/core.hpp>
#include <stdexcept>
#include <vector>

#include "redbee/bus/codec.hpp"

namespace redbee {
namespace {

/// Stores published messages and delivers none.
class RecordingBus : public Bus {
 public:
  using Bus::publish;
  void publish(const std::string& channel, const std::vector<uint8_t>& data) override {
    EXPECT_EQ(channel, "HEALTH");
    process_health_t message;
    ASSERT_TRUE(decodeMessage(data.data(), static_cast<int>(data.size()), message));
    health.push_back(message);
  }
  Subscription subscribe(const std::string&, int, Handler) override { return {}; }
  int handle(std::chrono::milliseconds) override { return 0; }
  int64_t handlerFailures() const override { return failures; }

  std::vector<process_health_t> health;
  int64_t failures = 0;
};

/// Does one thing per call of processNext(), then sets the stop flag.
class ScriptedNode : public Node {
 public:
  explicit ScriptedNode(std::vector<std::function<void(HealthMonitor&)>> script)
      : script_(std::move(script)) {}
  bool processNext() override {
    const size_t step = step_++;
    stop = step + 1 >= script_.size();
    script_[step](health_);
    return false;
  }
  void finish() override { finished = true; }
  HealthMonitor& health() override { return health_; }

  std::atomic<bool> stop{false};
  bool finished = false;

 private:
  std::vector<std::function<void(HealthMonitor&)>> script_;
  size_t step_ = 0;
  HealthMonitor health_{"scripted", "hash"};
};

std::vector<int> statesOf(const RecordingBus& bus) {
  std::vector<int> states;
  for (const auto& message : bus.health) states.push_back(message.state);
  return states;
}

TEST(RunNode, PublishesHealthAtTheStartAtChangesAndAtTheEnd) {
  RecordingBus bus;
  ScriptedNode node({[](HealthMonitor&) {}, [](HealthMonitor& h) { h.setState(HealthState::kGood); },
                     [](HealthMonitor&) {},
                     [](HealthMonitor& h) { h.setState(HealthState::kDegraded, "no IMU"); }});
  runNode(bus, node, "HEALTH", node.stop);
  EXPECT_THAT(statesOf(bus), testing::ElementsAre(0, 1, 2, 3));
  EXPECT_EQ(bus.health[2].message, "no IMU");
}

TEST(RunNode, ContinuesAfterAFrameThatThrew) {
  RecordingBus bus;
  bool reached = false;
  ScriptedNode node({[](HealthMonitor&) { throw std::runtime_error("singular matrix"); },
                     [&](HealthMonitor&) { reached = true; }});
  runNode(bus, node, "HEALTH", node.stop);
  EXPECT_TRUE(reached);
  EXPECT_EQ(bus.health.front().state, 2);
  EXPECT_THAT(bus.health.front().message, testing::HasSubstr("singular matrix"));
}

TEST(RunNode, EndsWhenMemoryIsExhaustedSoThatTheProcessIsRestarted) {
  RecordingBus bus;
  ScriptedNode node({[](HealthMonitor&) { throw std::bad_alloc(); }, [](HealthMonitor&) {}});
  EXPECT_THROW(runNode(bus, node, "HEALTH", node.stop), std::bad_alloc);
  ScriptedNode other(
      {[](HealthMonitor&) { CV_Error(cv::Error::StsNoMem, "no room"); }, [](HealthMonitor&) {}});
  EXPECT_THROW(runNode(bus, other, "HEALTH", other.stop), std::bad_alloc);
}

TEST(RunNode, AMessageWhoseHandlerThrewCountsAsDamaged) {
  RecordingBus bus;
  bus.failures = 3;
  ScriptedNode node({[](HealthMonitor&) {}, [](HealthMonitor&) {}});
  runNode(bus, node, "HEALTH", node.stop);
  EXPECT_EQ(bus.health.back().damaged, 3);
}

TEST(RunNode, DoesNothingWhenStoppedBefore) {
  RecordingBus bus;
  ScriptedNode node({[](HealthMonitor&) { FAIL() << "processed after the stop"; }});
  node.stop = true;
  runNode(bus, node, "HEALTH", node.stop);
  EXPECT_THAT(statesOf(bus), testing::ElementsAre(3));
}

TEST(RunNode, WhatWasReceivedBeforeTheStopIsProcessed) {
  RecordingBus bus;
  ScriptedNode node({[](HealthMonitor&) {}});
  runNode(bus, node, "HEALTH", node.stop);
  EXPECT_TRUE(node.finished);
}

TEST(StopOnSignals, TerminationSetsTheFlag) {
  const auto& stop = stopOnSignals();
  EXPECT_FALSE(stop);
  std::raise(SIGTERM);
  EXPECT_TRUE(stop);
  std::signal(SIGTERM, SIG_DFL);
  std::signal(SIGINT, SIG_DFL);
}

}  // namespace
}  // namespace redbee
