// Messages of a second source on a channel, and times that leap.
#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <optional>
#include <set>
#include <utility>

#include "tests/support/forgery.hpp"
#include "tests/support/trusted_frames.hpp"

namespace redbee::test {
namespace {

constexpr int64_t kHour = 3'600'000'000;
constexpr int64_t kAhead = 1'900'000;
constexpr int64_t kStranger = 4711;

struct Flown {
  TrustedFrames frames;
  int foreign = 0;  ///< trusted masks of frames that the first camera did not take
  std::map<std::string, process_health_t> health;
};

Flown fly(const char* name, const StackFlight& flight,
          const std::function<std::vector<Subscription>(Bus&)>& disturb = {}) {
  const auto bus = makeLcmBus("memq://");
  std::vector<Subscription> forgers;
  if (disturb) forgers = disturb(*bus);
  const StackOutput output = StackRun(flight, *bus).run();
  Flown flown{trustedFrames(output, flight), 0, output.health};
  const std::set<int64_t> own(flight.frame_utimes.begin(), flight.frame_utimes.end());
  for (const auto& [utime, foreground] : output.foreground) {
    flown.foreign += own.count(utime) == 0 && foreground.status == foreground_t::GOOD ? 1 : 0;
  }
  flown.frames.print(name);
  if (flown.foreign > 0) std::printf("  and %d trusted masks of foreign frames\n", flown.foreign);
  return flown;
}

/// `change` makes the second camera's message from each image of the first one; std::nullopt: none.
StackFlight withSecondCamera(const std::function<bool(int, image_t&)>& change) {
  StackFlight flight = undisturbedFlight();
  std::vector<SensorMessage> both;
  int frame = 0;
  for (const SensorMessage& sent : flight.messages) {
    both.push_back(sent);
    if (sent.channel != "CAMERA") continue;
    image_t other;
    if (!decodeMessage(sent.data.data(), static_cast<int>(sent.data.size()), other)) continue;
    std::reverse(other.data.begin(), other.data.end());  // turned by half a turn
    if (++frame < 20 || !change(frame, other)) continue;
    SensorMessage message = encoded(other);
    const int64_t offset = message.utime - sent.utime;
    message.utime = sent.utime + (std::abs(offset) < 1'000'000 ? offset : 1);
    both.push_back(message);
  }
  flight.messages = both;
  sortByTime(flight.messages);
  return flight;
}

TEST(SecondSource, AForgedFusedHomographyBesideTheTrueOneChangesNothing) {
  const Flown flown = fly("forged FUSED_HOMOGRAPHY, 7 px off", undisturbedFlight(), [](Bus& bus) {
    std::vector<Subscription> all;
    all.push_back(forge<fused_homography_t>(bus, "FUSED_HOMOGRAPHY", [](fused_homography_t& m) {
      m.step.H[2] += 7;
      m.anchor.H[2] += 7;
    }));
    return all;
  });
  EXPECT_EQ(flown.frames.trusted, flown.frames.expected);
  EXPECT_EQ(flown.frames.wild, 0);
  EXPECT_EQ(flown.foreign, 0);
}

/// Before the true one can have come: after the first is known, nobody else is listened to.
TEST(SecondSource, AForgedFusedHomographyThatIsFasterThanTheTrueOneChangesNothing) {
  fused_homography_t latest{};
  const Flown flown = fly("forged FUSED_HOMOGRAPHY, 7 px off, first", undisturbedFlight(), [&](Bus& bus) {
    std::vector<Subscription> all;
    all.push_back(bus.subscribe<fused_homography_t>("FUSED_HOMOGRAPHY", 64, [&](const fused_homography_t& m) {
      if (m.publisher != kStranger) latest = m;
    }));
    all.push_back(bus.subscribe<image_t>("CAMERA", 64, [&](const image_t& image) {
      if (latest.utime == 0 || image.utime <= latest.utime) return;
      fused_homography_t forged = latest;
      forged.utime_previous = forged.utime_tracks = latest.utime;
      forged.utime = image.utime;
      forged.publisher = kStranger;
      forged.step.H[2] += 7;
      forged.anchor.H[2] += 7;
      bus.publish("FUSED_HOMOGRAPHY", forged);
    }));
    return all;
  });
  EXPECT_EQ(flown.frames.trusted, flown.frames.expected);
  EXPECT_EQ(flown.frames.wild, 0);
}

TEST(SecondSource, CompanionsFromAheadCostNothing) {
  const Flown flown = fly("companions 1.9 s ahead", undisturbedFlight(), [](Bus& bus) {
    std::vector<Subscription> all;
    const auto ahead = [](auto& m) {
      m.utime += kAhead;
      m.utime_previous += kAhead;
    };
    all.push_back(forge<inertial_homography_t>(bus, "INERTIAL_HOMOGRAPHY", ahead));
    all.push_back(forge<visual_homography_t>(bus, "VISUAL_HOMOGRAPHY", ahead));
    all.push_back(forge<fused_homography_t>(bus, "FUSED_HOMOGRAPHY", ahead));
    return all;
  });
  EXPECT_EQ(flown.frames.trusted, flown.frames.expected);
  EXPECT_EQ(flown.frames.wild, 0);
  EXPECT_EQ(flown.foreign, 0);
}

TEST(SecondSource, ASecondCameraIsIgnored) {
  const Flown flown = fly("a second camera, 17 ms later", withSecondCamera([](int, image_t& m) {
                            m.utime += 17'000;
                            return true;
                          }));
  for (const char* process :
       {"redbee-imu-integration", "redbee-visual-homography", "redbee-motion-segmentation"}) {
    EXPECT_EQ(flown.health.at(process).message, "CAMERA: a second source is ignored") << process;
  }
  EXPECT_EQ(flown.frames.trusted, flown.frames.expected);
  EXPECT_EQ(flown.frames.wild, 0);
  EXPECT_EQ(flown.foreign, 0);
}

TEST(SecondSource, ACameraWhoseClockIsAnHourBehindIsIgnored) {
  const Flown flown = fly("a second camera, an hour behind", withSecondCamera([](int, image_t& m) {
                            m.utime -= kHour;
                            return true;
                          }));
  EXPECT_EQ(flown.frames.trusted, flown.frames.expected);
  EXPECT_EQ(flown.frames.wild, 0);
  EXPECT_EQ(flown.foreign, 0);
}

/// From the first message on, mounted a quarter turn from the first and read a third of a period after it.
TEST(SecondSource, AnImuThatIsMixedInFromTheBeginningIsIgnored) {
  StackFlight flight = undisturbedFlight();
  std::vector<SensorMessage> both;
  std::optional<int64_t> last;
  for (const SensorMessage& sent : flight.messages) {
    both.push_back(sent);
    ins_t other;
    if (sent.channel != "IMU" || !decodeMessage(sent.data.data(), static_cast<int>(sent.data.size()), other))
      continue;
    if (last) {
      for (double* v : {other.gyro, other.accel}) v[0] = -std::exchange(v[1], v[0]);
      other.utime += (sent.utime - *last) / 3;
      both.push_back(encoded(other));
    }
    last = sent.utime;
  }
  flight.messages = both;
  sortByTime(flight.messages);
  const Flown flown = fly("a second IMU from the beginning", flight);
  EXPECT_EQ(flown.health.at("redbee-imu-integration").message, "IMU: a second source is ignored");
  EXPECT_EQ(flown.health.at("redbee-homography-fusion").state, process_health_t::GOOD);
  EXPECT_EQ(flown.frames.trusted, flown.frames.expected);
  EXPECT_EQ(flown.frames.wild, 0);
}

TEST(SecondSource, StrayFramesFromAnHourAheadAreIgnored) {
  const Flown flown =
      fly("a stray frame an hour ahead each second", withSecondCamera([](int frame, image_t& m) {
            m.utime += kHour;
            return frame % 24 == 0;
          }));
  EXPECT_EQ(flown.frames.trusted, flown.frames.expected);
  EXPECT_EQ(flown.frames.wild, 0);
  EXPECT_EQ(flown.foreign, 0);
}

}  // namespace
}  // namespace redbee::test
