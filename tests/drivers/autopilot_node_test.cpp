// redbee-autopilot on a simulated link: what it publishes, what its health says, when it opens its device
// again.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <deque>

#include "processes/autopilot/node.hpp"
#include "redbee/ins_t.hpp"
#include "redbee/mavlink/attitude_message.hpp"
#include "redbee/mavlink/encoder.hpp"
#include "redbee/mavlink/messages.hpp"
#include "redbee/mavlink/parser.hpp"
#include "redbee/mavlink/sensor_messages.hpp"
#include "tests/support/camera.hpp"

namespace redbee::test {
namespace {

using mavlink::Bytes;
using testing::HasSubstr;

constexpr int64_t kMs = 1'000'000;
constexpr int64_t kBoot_ns = 3'000 * kMs;

/// An autopilot that answers TIMESYNC within the same millisecond; each receive() takes one.
struct Device {
  int64_t now_ns = 100'000 * kMs;
  std::string fault;  ///< of the next open()
  bool is_open = false;
  bool is_unplugged = false;
  bool answers = true;
  int opened = 0;
  std::deque<Bytes> incoming;
  mavlink::Encoder encoder{1, 1};
  mavlink::Parser parser;

  void hear(const Bytes& data) {
    parser.feed(data.data(), data.size());
    while (const auto frame = parser.next()) {
      if (frame->id != mavlink::Timesync::kId || !answers) continue;
      const auto request = frame->message<mavlink::Timesync>();
      incoming.push_back(encoder.encode(mavlink::Timesync{now_ns - kBoot_ns, request.ts1, 1, 191}));
    }
  }
};

class SimulatedLink : public Link {
 public:
  explicit SimulatedLink(Device& device) : device_(device) {}
  std::string open() override {
    ++device_.opened;
    device_.is_open = device_.fault.empty();
    return device_.fault;
  }
  bool isOpen() const override { return device_.is_open; }
  ReceivedBytes receive(std::chrono::milliseconds) override {
    ReceivedBytes received;
    if (device_.is_unplugged) device_.is_open = false;
    if (device_.is_open && !device_.incoming.empty()) {
      received.data = device_.incoming.front();
      device_.incoming.pop_front();
    }
    received.host_ns = device_.now_ns;
    device_.now_ns += kMs;
    return received;
  }
  bool send(const Bytes& data) override {
    device_.hear(data);
    return true;
  }
  bool isDatagram() const override { return true; }

 private:
  Device& device_;
};

class AutopilotNodeTest : public testing::Test {
 protected:
  AutopilotNodeTest() {
    node_ = nodeOf(configuration());
    subscription_ = bus_->subscribe<ins_t>("IMU", 1000, [this](const ins_t& m) { imu_.push_back(m); });
  }
  static Configuration configuration() {
    Configuration configuration;
    configuration.camera = intrinsics();
    configuration.autopilot.link = "serial:/dev/ttyACM0:921600";
    return configuration;
  }
  std::unique_ptr<AutopilotNode> nodeOf(const Configuration& configuration) {
    return std::make_unique<AutopilotNode>(*bus_, configuration, std::make_unique<SimulatedLink>(device_),
                                           [this] { return device_.now_ns; });
  }
  /// The clock of a closed link stands still: it is moved here.
  void passWhileClosed(int64_t ms) {
    device_.now_ns += ms * kMs;
    node_->processNext();
  }
  void run(int passes) {
    for (int i = 0; i < passes; ++i) node_->processNext();
    bus_->handle(std::chrono::milliseconds(0));
  }
  void sendHeartbeat() {
    device_.incoming.push_back(device_.encoder.encode(mavlink::Heartbeat{0, 2, 12, 0, 4, 3}));
  }
  void sendImu() {
    mavlink::HighresImu m;
    m.time_usec = static_cast<uint64_t>((device_.now_ns - kBoot_ns) / 1000);
    m.zacc = -9.81F;
    m.fields_updated = 0xffff;
    device_.incoming.push_back(device_.encoder.encode(m));
  }
  process_health_t health() { return node_->health().nextMessage(); }

  std::unique_ptr<Bus> bus_ = makeLcmBus("memq://");
  Device device_;
  std::unique_ptr<AutopilotNode> node_;
  Subscription subscription_;
  std::vector<ins_t> imu_;
};

TEST_F(AutopilotNodeTest, PublishesTheImuOnOurClock) {
  sendHeartbeat();
  run(600);
  const int64_t sent_us = device_.now_ns / 1000;
  sendImu();
  run(3);
  ASSERT_EQ(imu_.size(), 1U);
  // The first answers came after a millisecond, the later ones at once.
  EXPECT_NEAR(static_cast<double>(imu_[0].utime), static_cast<double>(sent_us), 100);
  EXPECT_EQ(imu_[0].device_time, sent_us - kBoot_ns / 1000);
  EXPECT_NEAR(imu_[0].accel[2], 9.81, 1e-5);
  EXPECT_EQ(health().state, process_health_t::GOOD);
}

TEST_F(AutopilotNodeTest, SaysWhatIsMissing) {
  device_.answers = false;
  run(10);
  EXPECT_THAT(health().message, HasSubstr("no heartbeat of system 1"));
  sendHeartbeat();
  run(10);
  EXPECT_THAT(health().message, HasSubstr("PX4 has not answered TIMESYNC"));
  device_.answers = true;
  run(600);
  sendHeartbeat();
  run(2000);
  EXPECT_THAT(health().message, HasSubstr("PX4 sends no message of an IMU"));
  node_->health().setInputSilence(5);
  EXPECT_THAT(health().message, HasSubstr("PX4 sends no message of an IMU; no input for 5 s"));
}

TEST_F(AutopilotNodeTest, SaysThatThereIsNoPoseWhereTargetsNeedOne) {
  Configuration with_targets = configuration();
  with_targets.geolocation.enabled = true;
  node_ = nodeOf(with_targets);
  sendHeartbeat();
  run(2500);
  sendHeartbeat();
  sendImu();
  run(3);
  EXPECT_THAT(health().message, HasSubstr("PX4 sends no attitude: there is no POSE"));
  device_.incoming.push_back(device_.encoder.encode(
      mavlink::Attitude{static_cast<uint32_t>((device_.now_ns - kBoot_ns) / 1'000'000)}));
  sendImu();
  run(3);
  EXPECT_EQ(health().state, process_health_t::GOOD) << health().message;
}

TEST_F(AutopilotNodeTest, OpensADeviceThatGoesAgainLessAndLessOften) {
  device_.fault = "/dev/ttyACM0: No such file or directory";
  node_->processNext();
  EXPECT_EQ(device_.opened, 1);
  EXPECT_EQ(health().message, device_.fault);
  passWhileClosed(50);
  EXPECT_EQ(device_.opened, 1);
  passWhileClosed(50);
  EXPECT_EQ(device_.opened, 2);
  passWhileClosed(150);
  EXPECT_EQ(device_.opened, 2);
  passWhileClosed(50);
  EXPECT_EQ(device_.opened, 3);
  device_.fault.clear();
  passWhileClosed(5000);
  EXPECT_TRUE(device_.is_open);
  device_.is_unplugged = true;
  run(2);
  EXPECT_THAT(health().message, HasSubstr("the device is gone"));
  device_.is_unplugged = false;
  passWhileClosed(5000);
  run(1);
  EXPECT_THAT(health().message, HasSubstr("no heartbeat"));
}

TEST_F(AutopilotNodeTest, CountsDamageAndLoss) {
  sendHeartbeat();
  run(600);
  sendImu();
  sendImu();
  sendImu();
  sendImu();
  device_.incoming[1][20] ^= 1;
  device_.incoming.erase(device_.incoming.begin() + 2);
  run(5);
  EXPECT_EQ(health().damaged, 1);
  EXPECT_EQ(health().lost, 2);  // the damaged one is missing, too
}

TEST(AutopilotNode, NeedsALink) {
  Configuration configuration;
  configuration.camera = intrinsics();
  const auto bus = makeLcmBus("memq://");
  EXPECT_THROW(AutopilotNode(*bus, configuration), UserError);
  configuration.autopilot.link = "serial:/dev/null:12345";
  EXPECT_THROW(AutopilotNode(*bus, configuration), UserError);
}

}  // namespace
}  // namespace redbee::test
