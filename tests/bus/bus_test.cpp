#include "redbee/bus/bus.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <numeric>
#include <stdexcept>

#include "tests/bus/sample_messages.hpp"

namespace redbee::test {
namespace {

using std::chrono::milliseconds;

class BusTest : public testing::Test {
 protected:
  std::unique_ptr<Bus> bus_ = makeLcmBus("memq://");
  std::vector<int64_t> received_;
  int damaged_ = 0;

  [[nodiscard]] Subscription collect(const std::string& channel) {
    return bus_->subscribe<altimeter_t>(
        channel, 30, [this](const altimeter_t& message) { received_.push_back(message.utime); },
        [this] { ++damaged_; });
  }
  void publish(const std::string& channel, int64_t utime) {
    auto message = sample<altimeter_t>();
    message.utime = utime;
    bus_->publish(channel, message);
  }
};

TEST_F(BusTest, DeliversEverythingThatWaitsInOrder) {
  const Subscription collected = collect("A");
  for (int i = 0; i < 100; ++i) publish("A", i);
  EXPECT_EQ(bus_->handle(milliseconds(0)), 100);
  std::vector<int64_t> expected(100);
  std::iota(expected.begin(), expected.end(), 0);
  EXPECT_EQ(received_, expected);
}

TEST_F(BusTest, DrainsWhatHandlersPublish) {
  const Subscription collected = collect("B");
  const Subscription relay = bus_->subscribe<altimeter_t>(
      "A", 30, [this](const altimeter_t& message) { publish("B", message.utime + 1); });
  publish("A", 1);
  EXPECT_EQ(bus_->handle(milliseconds(0)), 2);
  EXPECT_EQ(received_, std::vector<int64_t>{2});
}

TEST_F(BusTest, NothingWaitingIsNoMessage) {
  const Subscription collected = collect("A");
  EXPECT_EQ(bus_->handle(milliseconds(1)), 0);
}

TEST_F(BusTest, AChannelIsANameAndNoPattern) {
  const Subscription collected = collect("A.B");
  publish("AxB", 1);
  publish("A.B", 2);
  publish("A.B.C", 3);
  bus_->handle(milliseconds(0));
  EXPECT_EQ(received_, std::vector<int64_t>{2});
}

TEST_F(BusTest, ADamagedMessageIsCountedAndTheNextArrives) {
  const Subscription collected = collect("A");
  bus_->publish("A", std::vector<uint8_t>{1, 2, 3});
  publish("A", 5);
  bus_->handle(milliseconds(0));
  EXPECT_EQ(damaged_, 1);
  EXPECT_EQ(received_, std::vector<int64_t>{5});
}

TEST_F(BusTest, ExceptionsOfHandlersAreCaught) {
  const Subscription broken =
      bus_->subscribe("A", 30, [](const uint8_t*, int) { throw std::runtime_error("broken handler"); });
  const Subscription strange = bus_->subscribe("A", 30, [](const uint8_t*, int) { throw 1; });
  const Subscription collected = collect("A");
  publish("A", 1);
  publish("A", 2);
  EXPECT_EQ(bus_->handle(milliseconds(0)), 2);
  EXPECT_EQ(bus_->handlerFailures(), 4);
  EXPECT_EQ(received_.size(), 2U);
}

TEST_F(BusTest, ImpossibleChannelsAndSizesAreRefused) {
  EXPECT_THROW(publish("", 1), std::invalid_argument);
  EXPECT_THROW(publish(std::string(64, 'x'), 1), std::invalid_argument);
  EXPECT_THROW(collect(""), std::invalid_argument);
  EXPECT_THROW(bus_->publish("A", std::vector<uint8_t>((size_t{64} << 20) + 1)), std::length_error);
}

TEST_F(BusTest, ASubscriptionEndsWithItsOwner) {
  {
    const Subscription collected = collect("A");
    publish("A", 1);
    bus_->handle(milliseconds(0));
    publish("A", 2);
  }
  publish("A", 3);
  bus_->handle(milliseconds(0));
  EXPECT_EQ(received_, std::vector<int64_t>{1});
}

TEST_F(BusTest, AnAssignedSubscriptionReplacesTheFormer) {
  Subscription subscription = collect("A");
  subscription = collect("B");
  publish("A", 1);
  publish("B", 2);
  bus_->handle(milliseconds(0));
  EXPECT_EQ(received_, std::vector<int64_t>{2});
}

TEST_F(BusTest, ASubscriptionMayEndInsideItsOwnHandler) {
  Subscription once;
  once = bus_->subscribe<altimeter_t>("A", 30, [&](const altimeter_t& message) {
    once = Subscription();
    received_.push_back(message.utime);
  });
  const Subscription collected = collect("A");
  publish("A", 1);
  publish("A", 2);
  bus_->handle(milliseconds(0));
  EXPECT_EQ(received_, (std::vector<int64_t>{1, 1, 2}));
}

TEST_F(BusTest, ASubscriptionMayOutliveItsBus) {
  const Subscription collected = collect("A");
  bus_.reset();
}

TEST(LcmBus, AnUnknownProviderIsAnError) { EXPECT_THROW(makeLcmBus("nonsense://"), std::runtime_error); }

TEST(LcmBus, PolicyNoneAllowsOnlyMemory) {
  const char* before = std::getenv("REDBEE_NETWORK_POLICY");
  const std::string kept = before != nullptr ? before : "";
  setenv("REDBEE_NETWORK_POLICY", "none", 1);
  EXPECT_THROW(makeLcmBus("udpm://239.255.76.67:7667?ttl=0"), std::runtime_error);
  EXPECT_NO_THROW(makeLcmBus("memq://"));
  before != nullptr ? setenv("REDBEE_NETWORK_POLICY", kept.c_str(), 1) : unsetenv("REDBEE_NETWORK_POLICY");
}

}  // namespace
}  // namespace redbee::test
