// More messages than the stack can process: floods and a process that stalls.
#include <gtest/gtest.h>

#include "processes/node_factory.hpp"
#include "tests/support/allocated_bytes.hpp"
#include "tests/support/fault_trial.hpp"

namespace redbee::test {
namespace {

SensorMessage laterBy(const SensorMessage& sent, int64_t us) {
  SensorMessage later = sent;
  later.utime += us;
  const auto number = static_cast<uint64_t>(later.utime);
  for (int i = 0; i < 8; ++i)
    later.data[kHashBytes + static_cast<size_t>(i)] = static_cast<uint8_t>(number >> (56 - 8 * i));
  return later;
}

/// Thousands of messages, one microsecond apart, before any node processes one.
TEST(LoadFault, AFloodIsSkippedNotQueued) {
  const StackFlight& flight = undisturbedFlight();
  for (const std::string& channel : {std::string("CAMERA"), std::string("IMU"), std::string("ALTIMETER")}) {
    const auto bus = makeLcmBus("memq://");
    const SensorMessage sample = *std::find_if(
        flight.messages.begin(), flight.messages.end(),
        [&](const SensorMessage& a) { return a.channel == channel && a.utime >= beginTime(flight); });
    bool flooded = false;
    int64_t grown = 0;
    const StackOutput output = StackRun(flight, *bus).run([&](const SensorMessage& sent) {
      if (flooded || sent.utime < beginTime(flight)) return;
      flooded = true;
      const int64_t before = allocatedBytes();
      for (int i = 0; i < 20000; ++i) {
        bus->publish(channel, laterBy(sample, i).data);
        bus->handle(std::chrono::milliseconds(0));
      }
      grown = allocatedBytes() - before;
    });
    // 20000 images are 1.5 GB; what a queue of frames and the bus itself may hold is far below.
    EXPECT_LT(grown, int64_t{32} << 20) << channel << ": the backlog must be bounded";
    std::printf("20000 messages on %s cost %.1f MB\n", channel.c_str(), static_cast<double>(grown) / 1e6);
    expectRecovery("20000 messages on " + channel, output, flight, 24);
  }
}

/// A segmentation that is stopped repeatedly for a third of a second while the other processes continue.
TEST(LoadFault, ASlowSubscriberSkipsFramesAndDelaysNoOther) {
  const StackFlight& flight = undisturbedFlight();
  const auto bus = makeLcmBus("memq://");
  StackOutput output;
  const auto keep = [](auto& into) { return [&into](const auto& m) { into[m.utime] = m; }; };
  const Subscription fused = bus->subscribe<fused_homography_t>("FUSED_HOMOGRAPHY", 64, keep(output.fused));
  const Subscription foreground = bus->subscribe<foreground_t>("FOREGROUND", 64, keep(output.foreground));
  const Nodes quick = motionNodes(*bus, flight.configuration);
  const auto segmentation = makeNode(kMotionSegmentation, *bus, flight.configuration);
  for (const SensorMessage& sent : flight.messages) {
    bus->publish(sent.channel, sent.data);
    const bool stalled = isDisturbed(flight, sent.utime);
    do {
      for (const auto& node : quick) node->process();
      if (!stalled) segmentation->process();
    } while (bus->handle(std::chrono::milliseconds(0)) > 0);
  }
  segmentation->finish();
  bus->handle(std::chrono::milliseconds(0));
  expectRecovery("segmentation stalls for a second", output, flight, 24);
  const int within_wait =
      static_cast<int>(flight.configuration.waits.segmentation_s * (kFaultEnd - kFaultBegin));
  EXPECT_GE(segmentation->health().skipped(), kFaultEnd - kFaultBegin - within_wait - 1);
  for (int k = kFaultBegin; k < kFaultEnd; ++k) {
    EXPECT_EQ(output.fused.count(flight.frame_utimes[static_cast<size_t>(k)]), 1U) << "frame " << k;
  }
}

}  // namespace
}  // namespace redbee::test
