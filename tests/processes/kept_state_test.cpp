// An inertial process that is killed in flight goes on from what the flight had learned.
#include <gtest/gtest.h>

#include <iostream>

#include "processes/conversions.hpp"
#include "tests/processes/mortal_stack.hpp"
#include "tests/processes/stack_fixture.hpp"

namespace redbee::test {
namespace {

constexpr int kFrames = 264;
constexpr int kKilledAt = 216;  ///< nine seconds of flight have taught the height
constexpr int kDownFrames = 8;  ///< a third of a second: what supervisor needs

/// A drone without an altimeter whose configured height is 40 % off, and says no more than that.
const Flight& flightOfWrongHeight() {
  static const Flight flight = [] {
    Flight f = fly(simulation::groundOnly(3), kFrames);
    f.configuration.has_altimeter = false;
    auto& extrinsics = f.configuration.inertial.extrinsics;
    extrinsics.start_height_sigma_m = 0.4 * extrinsics.start_height_m;
    extrinsics.start_height_m *= 0.6;
    return f;
  }();
  return flight;
}

std::map<int64_t, inertial_homography_t> flyAndKill(const Flight& flight) {
  const auto bus = makeLcmBus("memq://");
  std::map<int64_t, inertial_homography_t> said;
  bus->subscribe<inertial_homography_t>(
      "INERTIAL_HOMOGRAPHY", 64, [&](const inertial_homography_t& m) { said[m.utime] = m; }, nullptr);
  MortalStack stack(*bus, flight.configuration);
  int frame = -1;
  for (const Arrival& arrival : flight.arrivals) {
    if (arrival.channel == "CAMERA") {
      ++frame;
      if (frame == kKilledAt) stack.kill(kImu);
      if (frame == kKilledAt + kDownFrames) stack.start(kImu);
    }
    bus->publish(arrival.channel, arrival.data);
    stack.settle();
  }
  return said;
}

TEST(KeptState, Figures) {
  const Flight& flight = flightOfWrongHeight();
  const auto said = flyAndKill(flight);
  for (int k = 0; k < kFrames; ++k) {
    const auto it = said.find(flight.frame_utimes[static_cast<size_t>(k)]);
    if (it == said.end()) continue;
    const auto& m = it->second;
    std::printf("%d valid %d error %.3f px height %.3f +- %.3f\n", k, m.valid,
                meanTransferError(matrix3(m.H), flight.homographies[static_cast<size_t>(k)], m.width, m.height),
                m.camera_height, m.camera_height_sigma);
  }
}

}  // namespace
}  // namespace redbee::test
