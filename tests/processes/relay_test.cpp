// A lossy relay: loss, reordering and duplicates on every channel of the stack, for the whole flight.
#include <gtest/gtest.h>

#include <set>

#include "tests/support/relay_bus.hpp"
#include "tests/support/trusted_frames.hpp"

namespace redbee::test {
namespace {

/// Frames whose image arrived, and those of them that were trusted.
TrustedFrames flyThrough(const RelayFaults& faults, unsigned seed) {
  const StackFlight& flight = undisturbedFlight();
  const auto bus = makeLcmBus("memq://");
  RelayBus relay(*bus, faults, seed);
  std::set<int64_t> without_image;
  relay.onLost = [&](const std::string& channel, const std::vector<uint8_t>& data) {
    image_t image;
    if (channel == "CAMERA" && decodeMessage(data.data(), static_cast<int>(data.size()), image)) {
      without_image.insert(image.utime);
    }
  };
  const StackOutput output =
      StackRun(flight, relay).run([&](const SensorMessage& sent) { relay.advance(sent.utime); });
  return trustedFrames(output, flight, without_image);
}

TrustedFrames flyThroughAll(const char* name, const RelayFaults& faults) {
  TrustedFrames sum;
  for (unsigned seed = 1; seed <= 3; ++seed) sum += flyThrough(faults, seed);
  sum.print(name);
  return sum;
}

void expectNothingLost(const char* name, const RelayFaults& faults) {
  const TrustedFrames frames = flyThroughAll(name, faults);
  EXPECT_EQ(frames.trusted, frames.expected);
  EXPECT_EQ(frames.wild, 0);
}

TEST(Relay, FivePercentLostCostNoFrameWhoseImageArrived) { expectNothingLost("5 % lost", {0.05, 0, 0}); }

TEST(Relay, TwentyPercentLostCostOneFrameInTen) {
  const TrustedFrames frames = flyThroughAll("20 % lost", {0.2, 0, 0});
  EXPECT_GE(frames.trusted, 0.9 * frames.expected);
  EXPECT_EQ(frames.wild, 0);
}

TEST(Relay, ReorderingCostsNothing) {
  expectNothingLost("10 % delayed by 25 to 75 ms", {0, 0, 0.1});
  expectNothingLost("30 % delayed by 25 to 75 ms", {0, 0, 0.3});
}

TEST(Relay, EveryMessageDelayedDifferently) { expectNothingLost("all delayed by 25 to 75 ms", {0, 0, 1}); }

TEST(Relay, DuplicatesCostNothing) { expectNothingLost("30 % duplicated", {0, 0.3, 0}); }

}  // namespace
}  // namespace redbee::test
