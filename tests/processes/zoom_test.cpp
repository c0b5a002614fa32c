// A simulated flight whose lens zooms, with exact truth: what the stack makes of it with LENS, as if the
// focal length were fixed, and by vision alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/flight_measures.hpp"

namespace redbee::test {
namespace {

constexpr int kFrames = 96;

StackFlight zoomFlight() { return stackFlight(simulation::zoomWalkers(2), kFrames); }

void eraseLens(StackFlight& flight, int64_t from, int64_t to) {
  auto& messages = flight.messages;
  const auto is_lost = [&](const SensorMessage& m) {
    return m.channel == "LENS" && m.utime >= from && m.utime < to;
  };
  messages.erase(std::remove_if(messages.begin(), messages.end(), is_lost), messages.end());
}

TEST(ZoomFlight, TheInertialHomographyHoldsWhileTheLensZooms) {
  StackFlight flight = zoomFlight();
  const FlightMeasures used = measured("LENS used", flight);
  flight.configuration.inertial.lens.enabled = false;
  const FlightMeasures ignored = measured("LENS ignored", flight);
  flight.configuration.has_imu = false;
  measured("vision alone", flight);
  const FlightMeasures fixed =
      measured("a fixed lens, the same flight", stackFlight(simulation::briskWalkers(2), kFrames));
  EXPECT_EQ(used.inertial_part, 1);
  EXPECT_LT(used.inertial_px, fixed.inertial_px + 0.5);
  EXPECT_LT(used.fused_px, 0.1);
  EXPECT_EQ(ignored.inertial_part, 0) << "vision contradicts it: there was something to heed";
  EXPECT_LT(used.error_at_half_recall, fixed.error_at_half_recall + 0.05);
}

/// A lens that is distorted as well is rectified at its own focal length.
TEST(ZoomFlight, ADistortedLensIsRectifiedAsItStands) {
  simulation::Scenario scenario = simulation::zoomWalkers(2);
  scenario.intrinsics.distortion = {-0.2, 0.03, 0, 0, 0};
  StackFlight flight = stackFlight(scenario, kFrames);
  const FlightMeasures used = measured("distorted, LENS used", flight);
  flight.configuration.inertial.lens.enabled = false;
  const FlightMeasures ignored = measured("distorted, LENS ignored", flight);
  EXPECT_LT(used.fused_px, 0.15);
  EXPECT_LT(used.fused_px, ignored.fused_px / 2);
  EXPECT_LT(used.error_at_half_recall, ignored.error_at_half_recall + 0.02);
}

/// Without an IMU the lens still says how each image is rectified.
TEST(ZoomFlight, VisionAloneHeedsTheLens) {
  simulation::Scenario scenario = simulation::zoomWalkers(2);
  scenario.intrinsics.distortion = {-0.2, 0.03, 0, 0, 0};
  StackFlight flight = stackFlight(scenario, kFrames);
  flight.configuration.has_imu = false;
  const FlightMeasures used = measured("vision alone, distorted, LENS used", flight);
  flight.configuration.inertial.lens.enabled = false;
  const FlightMeasures ignored = measured("vision alone, distorted, LENS ignored", flight);
  EXPECT_LT(used.fused_px, ignored.fused_px / 2);
}

/// What is not there is not missed: an IMU that is not configured, but the lens that is.
TEST(ZoomFlight, WithoutAnImuTheHealthIsAboutTheLens) {
  StackFlight flight = zoomFlight();
  flight.configuration.has_imu = false;
  const auto healthOf = [&] { return StackRun(flight).run().health.at("redbee-imu-integration"); };
  const process_health_t with_lens = healthOf();
  EXPECT_EQ(with_lens.state, process_health_t::GOOD) << with_lens.message;
  EXPECT_EQ(with_lens.message, "");
  eraseLens(flight, flight.frame_utimes[48], flight.frame_utimes.back() + 1'000'000);
  const process_health_t without = healthOf();
  EXPECT_EQ(without.state, process_health_t::DEGRADED);
  EXPECT_NE(without.message.find("no LENS near the frame"), std::string::npos) << without.message;
}

/// Changes what the stack publishes on the way.
class EditingBus : public Bus {
 public:
  using Bus::publish;
  EditingBus(Bus& bus, bool fusion_knows, bool vision_knows)
      : bus_(bus), fusion_knows_(fusion_knows), vision_knows_(vision_knows) {}

  void publish(const std::string& channel, const std::vector<uint8_t>& data) override {
    if (channel == "FUSED_HOMOGRAPHY" && !fusion_knows_) return forget<fused_homography_t>(channel, data);
    if (channel == "VISUAL_HOMOGRAPHY" && !vision_knows_) return forget<visual_homography_t>(channel, data);
    bus_.publish(channel, data);
  }
  Subscription subscribe(const std::string& channel, int capacity, Handler handler) override {
    return bus_.subscribe(channel, capacity, std::move(handler));
  }
  int handle(std::chrono::milliseconds timeout) override { return bus_.handle(timeout); }
  int64_t handlerFailures() const override { return bus_.handlerFailures(); }

 private:
  template <typename Message>
  void forget(const std::string& channel, const std::vector<uint8_t>& data) {
    Message message;
    ASSERT_TRUE(decodeMessage(data.data(), static_cast<int>(data.size()), message));
    message.zoom = 0;
    bus_.publish(channel, encodeMessage(message));
  }

  Bus& bus_;
  bool fusion_knows_, vision_knows_;
};

/// The images of masks lie by the focal length: where the fusion does not know it, vision does.
TEST(ZoomFlight, TheSegmentationHeedsVisionsZoomWhereTheFusionKnowsNone) {
  simulation::Scenario scenario = simulation::zoomWalkers(2);
  scenario.intrinsics.distortion = {-0.2, 0.03, 0, 0, 0};
  const StackFlight flight = stackFlight(scenario, 48);
  const auto masksWith = [&](bool fusion_knows, bool vision_knows) {
    const auto bus = makeLcmBus("memq://");
    EditingBus editing(*bus, fusion_knows, vision_knows);
    std::vector<std::vector<uint8_t>> masks;
    for (const auto& [utime, message] : StackRun(flight, editing).run().foreground)
      masks.push_back(message.mask);
    return masks;
  };
  const auto expected = masksWith(true, true);
  EXPECT_EQ(masksWith(false, true), expected);
  EXPECT_NE(masksWith(false, false), expected) << "there was something to heed";
}

/// Nothing stops where LENS does: the focal length is a guess, which the covariance knows, and it is said.
TEST(ZoomFlight, WhileTheLensIsSilentVisionCountsMore) {
  StackFlight flight = zoomFlight();
  const FlightMeasures whole = measured("LENS used", flight);
  const auto from = flight.frame_utimes[48];
  eraseLens(flight, from, from + 1'000'000);
  const FlightMeasures gap = measured("LENS silent for a second", flight);
  EXPECT_LT(gap.fused_px, whole.fused_px + 0.05);
  EXPECT_LT(gap.error_at_half_recall, whole.error_at_half_recall + 0.05);
  eraseLens(flight, from, flight.frame_utimes.back() + 1'000'000);
  const StackOutput output = StackRun(flight).run();
  const process_health_t& health = output.health.at("redbee-imu-integration");
  EXPECT_EQ(health.state, process_health_t::DEGRADED);
  EXPECT_NE(health.message.find("no LENS near the frame"), std::string::npos) << health.message;
}

TEST(ZoomFlight, MessagesSayTheFocalLengthOfTheirFrame) {
  const simulation::FlightSimulator simulator(simulation::zoomWalkers(2));
  const StackFlight flight = zoomFlight();
  const StackOutput output = StackRun(flight).run();
  for (int k = 24; k < kFrames; ++k) {
    const int64_t utime = flight.frame_utimes[static_cast<size_t>(k)];
    EXPECT_NEAR(output.inertial.at(utime).zoom, simulator.zoom(k), 0.005) << k;
    EXPECT_EQ(output.visual.at(utime).zoom, output.inertial.at(utime).zoom) << k;
    EXPECT_EQ(output.fused.at(utime).zoom, output.inertial.at(utime).zoom) << k;
  }
}

}  // namespace
}  // namespace redbee::test
