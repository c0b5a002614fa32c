// The page's process gives signs of life while it is busy, and waits for none of its viewers.
#include <atomic>
#include <thread>

#include "processes/serve/node.hpp"
#include "tests/serve/watched_ground.hpp"

namespace redbee::test {
namespace {

constexpr int kMessages = 40;
constexpr std::chrono::seconds kLong{60};

/// A pass of the main loop handles all that has come: where that takes long, the watch must not miss it.
TEST(BusyPage, BeatsWithEveryMessageThatItHandles) {
  const auto bus = makeLcmBus("memq://");
  Configuration configuration;
  configuration.camera = intrinsics();
  Live live;
  LiveMosaic mosaic(configuration);
  ServeNode node(*bus, configuration, live, mosaic);
  const auto viewer = live.join();
  node.processNext();  // sees the viewer, and subscribes to images
  int beats = 0;
  node.health().onProgress([&] { ++beats; });
  for (int k = 0; k < kMessages; ++k) {
    bus->publish(configuration.channels.camera,
                 rawGreyMessage(utimeOf(k), cv::Mat1b(kHeight, kWidth, uchar{90})));
    detections_t detections{};
    detections.utime = utimeOf(k);
    detections.status = foreground_t::LEARNING;
    bus->publish(configuration.channels.detections, detections);
  }
  for (const auto end = std::chrono::steady_clock::now() + kLong;
       beats < 2 * kMessages && std::chrono::steady_clock::now() < end;)
    bus->handle(std::chrono::milliseconds(10));
  EXPECT_EQ(beats, 2 * kMessages);
}

using BusyMosaic = WatchedGround;

/// While somebody's mosaic is painted, the thread of the bus is told so, instead of waiting for him.
TEST_F(BusyMosaic, IsReleasedLaterWhileItIsPainted) {
  step(0);
  ask();
  for (int k = 1; k < 100; k += 20) {
    fly(k, k + 20);
    ask();
  }
  std::atomic<bool> is_over{false};
  std::thread viewer([&, asked = now_ + std::chrono::hours(1)] {
    while (!is_over) mosaic().newest(-1, asked);
  });
  bool was_busy = false;
  for (const auto end = std::chrono::steady_clock::now() + kLong;
       !was_busy && std::chrono::steady_clock::now() < end;) {
    fly(100, 105);
    was_busy = !mosaic().release();
    step(99);
  }
  is_over = true;
  viewer.join();
  EXPECT_TRUE(was_busy);
  EXPECT_TRUE(mosaic().release()) << "nobody paints any more";
}

}  // namespace
}  // namespace redbee::test
