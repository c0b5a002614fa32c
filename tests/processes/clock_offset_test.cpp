// The camera's clock is off the IMU's, all flight long or for some seconds of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "tests/support/trusted_frames.hpp"

namespace redbee::test {
namespace {

constexpr int kFrames = 200;
constexpr int kOffFrom = 50;
constexpr int kOffUntil = 110;

const StackFlight& flight() {
  static const StackFlight flight = faultFlight(kFrames);
  return flight;
}

/// The IMU's and the altimeter's clocks are set back while `is_off(utime)`, so that the camera's is ahead by
/// `offset`; the order of arrival stays.
StackFlight withCameraAhead(Duration offset, const std::function<bool(int64_t utime)>& is_off) {
  StackFlight changed = flight();
  for (SensorMessage& sent : changed.messages) {
    if (sent.channel == "CAMERA" || !is_off(sent.utime)) continue;
    const auto shift = [&](auto m) {
      if (!decodeMessage(sent.data.data(), static_cast<int>(sent.data.size()), m)) {
        throw std::logic_error("the simulated flight holds a message that does not decode");
      }
      m.utime -= offset.count();
      sent = encoded(m);
    };
    sent.channel == "IMU" ? shift(ins_t{}) : shift(altimeter_t{});
  }
  return changed;
}

struct Sources {
  int visual = 0;
  int with_imu = 0;
};
Sources sourcesFrom(const StackOutput& output, int begin, int end) {
  Sources sources;
  for (int k = begin; k < end; ++k) {
    const auto fused = output.fused.find(flight().frame_utimes[static_cast<size_t>(k)]);
    if (fused == output.fused.end()) continue;
    sources.visual += fused->second.source == fused_homography_t::VISUAL ? 1 : 0;
    const bool with_imu = fused->second.source == fused_homography_t::FUSED ||
                          fused->second.source == fused_homography_t::INERTIAL;
    sources.with_imu += with_imu ? 1 : 0;
  }
  return sources;
}

/// From the first frame to the decision.
struct Start {
  int named_at = -1;
  int by_imu = 0;  ///< frames that have a homography of vision, but the IMU's was followed
  double worst_false_fraction = 0;
};
Start startOf(const StackOutput& output) {
  Start start;
  for (int k = 1; k < kFrames && start.named_at < 0; ++k) {
    const int64_t utime = flight().frame_utimes[static_cast<size_t>(k)];
    const auto inertial = output.inertial.find(utime);
    const bool is_named = inertial != output.inertial.end() &&
                          inertial->second.status == inertial_homography_t::VISION_DISAGREES;
    if (is_named) start.named_at = k;
    const auto visual = output.visual.find(utime);
    const bool has_visual =
        visual != output.visual.end() && visual->second.status == visual_homography_t::GOOD;
    const bool is_inertial = output.fused.at(utime).source == fused_homography_t::INERTIAL;
    start.by_imu += has_visual && is_inertial ? 1 : 0;
    const auto foreground = output.foreground.find(utime);
    if (foreground == output.foreground.end() || foreground->second.status != foreground_t::GOOD) continue;
    const cv::Mat wrong = maskOf(foreground->second) & (flight().masks[static_cast<size_t>(k)] == 0);
    start.worst_false_fraction =
        std::max(start.worst_false_fraction, cv::countNonZero(wrong) / static_cast<double>(wrong.total()));
  }
  return start;
}

class ClockOffset : public testing::TestWithParam<int> {};

TEST_P(ClockOffset, LeavesTheImuOutAndIsNamed) {
  const Duration offset = std::chrono::milliseconds(GetParam());
  const StackOutput output = StackRun(withCameraAhead(offset, [](int64_t) { return true; })).run();
  // The decision takes a second and more; where the drone hardly turns, longer.
  const Sources sources = sourcesFrom(output, 72, kFrames);
  EXPECT_GE(sources.visual, (kFrames - 72) * 95 / 100);
  EXPECT_EQ(sources.with_imu, 0);
  const TrustedFrames frames = trustedFrames(output, flight(), {}, 72);
  EXPECT_GE(frames.trusted, frames.expected * 95 / 100);
  EXPECT_EQ(frames.wild, 0);

  // Until it is decided, what the IMU says is not followed against vision, and no mask has false area.
  const Start start = startOf(output);
  std::printf("named at frame %d; %d frames by the IMU against vision; false area at most %.2f %%\n",
              start.named_at, start.by_imu, 100 * start.worst_false_fraction);
  EXPECT_EQ(start.by_imu, 0);
  EXPECT_LT(start.worst_false_fraction, 0.005);
  const TrustedFrames all = trustedFrames(output, flight());
  EXPECT_EQ(all.trusted, all.expected);
  EXPECT_EQ(all.wild, 0);

  const process_health_t& inertial = output.health.at("redbee-imu-integration");
  EXPECT_EQ(inertial.state, process_health_t::DEGRADED);
  char expected[80];
  std::snprintf(expected, sizeof expected, "IMU and camera disagree: the camera's clock is about %.1f",
                std::abs(GetParam()) / 1000.0);
  EXPECT_EQ(inertial.message.substr(0, std::strlen(expected)), expected) << inertial.message;
  EXPECT_NE(inertial.message.find(GetParam() > 0 ? "ahead" : "behind"), std::string::npos);
  EXPECT_NE(output.health.at("redbee-homography-fusion").calibration, "fits");
}

INSTANTIATE_TEST_SUITE_P(Milliseconds, ClockOffset, testing::Values(100, -100, 200, -500, 500));

TEST(ClockOffsetInFlight, TheImuIsUsedAgainOnceTheClocksAgree) {
  const int64_t from = flight().frame_utimes[kOffFrom];
  const int64_t until = flight().frame_utimes[kOffUntil];
  const StackOutput output = StackRun(withCameraAhead(std::chrono::milliseconds(100), [&](int64_t utime) {
                               return utime >= from && utime < until;
                             })).run();
  EXPECT_EQ(sourcesFrom(output, 1, kOffFrom).with_imu, kOffFrom - 1);
  EXPECT_EQ(sourcesFrom(output, kOffFrom + 36, kOffUntil).with_imu, 0);
  EXPECT_EQ(sourcesFrom(output, kFrames - 12, kFrames).with_imu, 12);
  const TrustedFrames frames = trustedFrames(output, flight(), {}, kOffFrom + 36);
  EXPECT_EQ(frames.wild, 0);
  EXPECT_EQ(output.health.at("redbee-imu-integration").state, process_health_t::GOOD);
}

TEST(ClockOffsetInFlight, WithoutOneTheImuIsUsed) {
  const StackOutput output = StackRun(flight()).run();
  EXPECT_EQ(sourcesFrom(output, 1, kFrames).with_imu, kFrames - 1);
}

}  // namespace
}  // namespace redbee::test
