#include "redbee/bus/bus.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <stdexcept>

#include "tests/bus/sample_messages.hpp"

namespace redbee::test {
namespace {

using std::chrono::milliseconds;

class BusTest : public testing::Test {
 protected:
  std::unique_ptr<Bus> bus_ = makeLcmBus("memq://");
  std::vector<int64_t> heard_;
  int damaged_ = 0;

  void hear(const std::string& channel) {
    bus_->subscribe<altimeter_t>(
        channel, 30, [this](const altimeter_t& message) { heard_.push_back(message.utime); },
        [this] { ++damaged_; });
  }
  void say(const std::string& channel, int64_t utime) {
    auto message = sample<altimeter_t>();
    message.utime = utime;
    bus_->publish(channel, message);
  }
};

TEST_F(BusTest, DeliversEverythingThatWaitsInOrder) {
  hear("A");
  for (int i = 0; i < 100; ++i) say("A", i);
  EXPECT_EQ(bus_->handle(milliseconds(0)), 100);
  EXPECT_EQ(heard_, counted<int64_t>(100, 0));
}

TEST_F(BusTest, DrainsWhatHandlersPublish) {
  hear("B");
  bus_->subscribe<altimeter_t>("A", 30, [this](const altimeter_t& message) { say("B", message.utime + 1); },
                               {});
  say("A", 1);
  EXPECT_EQ(bus_->handle(milliseconds(0)), 2);
  EXPECT_EQ(heard_, std::vector<int64_t>{2});
}

TEST_F(BusTest, NothingWaitingIsNoMessage) {
  hear("A");
  EXPECT_EQ(bus_->handle(milliseconds(1)), 0);
}

TEST_F(BusTest, AChannelIsANameAndNoPattern) {
  hear("A.B");
  say("AxB", 1);
  say("A.B", 2);
  say("A.B.C", 3);
  bus_->handle(milliseconds(0));
  EXPECT_EQ(heard_, std::vector<int64_t>{2});
}

TEST_F(BusTest, ADamagedMessageIsCountedAndTheNextArrives) {
  hear("A");
  bus_->publish("A", std::vector<uint8_t>{1, 2, 3});
  say("A", 5);
  bus_->handle(milliseconds(0));
  EXPECT_EQ(damaged_, 1);
  EXPECT_EQ(heard_, std::vector<int64_t>{5});
}

TEST_F(BusTest, AnExceptionOfAHandlerGoesNoFurther) {
  bus_->subscribe("A", 30, [](const uint8_t*, int) { throw std::runtime_error("broken handler"); });
  bus_->subscribe("A", 30, [](const uint8_t*, int) { throw 1; });
  hear("A");
  say("A", 1);
  say("A", 2);
  EXPECT_EQ(bus_->handle(milliseconds(0)), 2);
  EXPECT_EQ(bus_->handlerFailures(), 4);
  EXPECT_EQ(heard_.size(), 2U);
}

TEST_F(BusTest, ImpossibleChannelsAndSizesAreRefused) {
  EXPECT_THROW(say("", 1), std::invalid_argument);
  EXPECT_THROW(say(std::string(64, 'x'), 1), std::invalid_argument);
  EXPECT_THROW(hear(""), std::invalid_argument);
  EXPECT_THROW(bus_->publish("A", std::vector<uint8_t>((size_t{64} << 20) + 1)), std::length_error);
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
