// Each stage misses other messages than the others do, as on a network that loses them on the way to one
// receiver.
#include <gtest/gtest.h>

#include <memory>
#include <set>
#include <vector>

#include "processes/node_factory.hpp"
#include "redbee/configuration/process_table.hpp"
#include "tests/support/deaf_bus.hpp"
#include "tests/support/trusted_frames.hpp"

namespace redbee::test {
namespace {

TrustedFrames flyWith(double lost, unsigned seed) {
  const StackFlight& flight = undisturbedFlight();
  const auto bus = makeLcmBus("memq://");
  std::vector<std::unique_ptr<DeafBus>> receivers;
  std::set<int64_t> without_image;
  Nodes nodes;
  for (const ProcessDescription* stage : kStages) {
    receivers.push_back(
        std::make_unique<DeafBus>(*bus, lost, 10 * seed + static_cast<unsigned>(receivers.size())));
    nodes.push_back(makeNode(*stage, *receivers.back(), flight.configuration));
  }
  receivers.back()->onLost = [&](const std::string& channel, const std::vector<uint8_t>& data) {
    image_t image;
    if (channel == "CAMERA" && decodeMessage(data.data(), static_cast<int>(data.size()), image)) {
      without_image.insert(image.utime);
    }
  };
  InProcessStack stack(*bus, flight.configuration.channels.health, std::move(nodes));
  const StackOutput output = StackRun(flight, *bus).run(stack);
  return trustedFrames(output, flight, without_image);
}

TrustedFrames flyThroughAll(const char* name, double lost, unsigned flights) {
  TrustedFrames sum;
  for (unsigned seed = 1; seed <= flights; ++seed) sum += flyWith(lost, seed);
  sum.print(name);
  return sum;
}

TEST(DeafStage, FivePercentCostAlmostNoFrameWhoseImageArrived) {
  const TrustedFrames frames = flyThroughAll("5 % lost on the way to each stage", 0.05, 6);
  EXPECT_GE(frames.trusted, 0.98 * frames.expected);
  EXPECT_EQ(frames.wild, 0);
}

/// One frame in 25 reaches the segmentation alone: nobody can say how the camera moved.
TEST(DeafStage, TwentyPercentCostOneFrameInTen) {
  const TrustedFrames frames = flyThroughAll("20 % lost on the way to each stage", 0.2, 18);
  EXPECT_GE(frames.trusted, 0.9 * frames.expected);
  EXPECT_EQ(frames.wild, 0);
}

}  // namespace
}  // namespace redbee::test
