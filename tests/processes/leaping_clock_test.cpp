// The times of the camera leap, and with them what the IMU and vision are compared by.
#include <gtest/gtest.h>

#include <functional>

#include "tests/support/trusted_frames.hpp"

namespace redbee::test {
namespace {

constexpr int kFrames = 200;
constexpr int64_t kHour = 3'600'000'000;

/// `imageOffset(frame)` and `sensorOffset(frame)` are added to the times of images and of the other sensors;
/// messages arrive as before.
StackFlight withTimes(const std::function<int64_t(int)>& imageOffset,
                      const std::function<int64_t(int)>& sensorOffset) {
  StackFlight flight = faultFlight(kFrames);
  int frame = 0;
  for (SensorMessage& sent : flight.messages) {
    const auto shift = [&](auto m, int64_t offset) {
      if (!decodeMessage(sent.data.data(), static_cast<int>(sent.data.size()), m))
        throw std::logic_error("the simulated flight holds a message that does not decode");
      m.utime += offset;
      sent = encoded(m);
    };
    if (sent.channel == "CAMERA") {
      flight.frame_utimes[static_cast<size_t>(frame)] += imageOffset(frame);
      shift(image_t{}, imageOffset(frame));
      ++frame;
    } else {
      sent.channel == "IMU" ? shift(ins_t{}, sensorOffset(frame)) : shift(altimeter_t{}, sensorOffset(frame));
    }
  }
  return flight;
}

/// Frames from `begin` on whose homography has a part of the IMU.
int withImu(const StackOutput& output, const StackFlight& flight, int begin) {
  int count = 0;
  for (int k = begin; k < kFrames; ++k) {
    const auto fused = output.fused.find(flight.frame_utimes[static_cast<size_t>(k)]);
    if (fused == output.fused.end()) continue;
    const int8_t source = fused->second.source;
    count += source == fused_homography_t::FUSED || source == fused_homography_t::INERTIAL ? 1 : 0;
  }
  return count;
}

int64_t none(int) { return 0; }

TEST(LeapingClock, FramesThatAreStampedLateAreNoDisagreement) {
  const StackFlight flight = withTimes([](int k) { return k % 12 == 5 ? 12'000 : 0; }, none);
  const StackOutput output = StackRun(flight).run();
  EXPECT_GE(withImu(output, flight, 1), kFrames - 1 - kFrames / 20);
  const TrustedFrames frames = trustedFrames(output, flight);
  frames.print("one frame in 12 stamped 12 ms late");
  EXPECT_GE(frames.trusted, frames.expected * 95 / 100);
  EXPECT_EQ(frames.wild, 0);
}

TEST(LeapingClock, AnHourAheadAndBackTheImuIsUsedAgain) {
  const StackFlight flight = withTimes([](int k) { return k >= 60 && k < 110 ? kHour : 0; }, none);
  const StackOutput output = StackRun(flight).run();
  const TrustedFrames frames = trustedFrames(output, flight);
  frames.print("camera an hour ahead for two seconds");
  EXPECT_EQ(frames.wild, 0);
  EXPECT_EQ(withImu(output, flight, 140), kFrames - 140);
  EXPECT_EQ(output.health.at("redbee-imu-integration").state, process_health_t::GOOD);
}

/// The doubt does not outlast the clock that it was about.
TEST(LeapingClock, TheDoubtEndsWhereBothClocksAreSetBackToEachOther) {
  constexpr int kSetBack = 120;
  const StackFlight flight = withTimes([](int k) { return k < kSetBack ? 500'000 : -10'000'000; },
                                       [](int k) { return k < kSetBack ? 0 : -10'000'000; });
  const StackOutput output = StackRun(flight).run();
  EXPECT_EQ(withImu(output, flight, 100) - withImu(output, flight, kSetBack), 0)
      << "the trial has no difficulty";
  EXPECT_EQ(withImu(output, flight, kSetBack + 20), kFrames - kSetBack - 20);
  const TrustedFrames frames = trustedFrames(output, flight, {}, kSetBack + 20 + kLearningFrames);
  EXPECT_EQ(frames.trusted, frames.expected);
  EXPECT_EQ(frames.wild, 0);
  EXPECT_EQ(output.health.at("redbee-imu-integration").state, process_health_t::GOOD);
}

}  // namespace
}  // namespace redbee::test
