#include "processes/redbee/vehicle/health_board.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "redbee/configuration/process_table.hpp"
#include "redbee/node/health.hpp"

namespace redbee {
namespace {

using testing::HasSubstr;
using Clock = std::chrono::steady_clock;
using std::chrono::seconds;

const Clock::time_point kNow = Clock::time_point(std::chrono::hours(1));

process_health_t healthOf(const std::string& process, HealthState state, int pid = 100) {
  process_health_t health{};
  health.process = process;
  health.pid = pid;
  health.state = static_cast<int8_t>(state);
  health.rate_in = 24;
  health.rate_out = 23.5;
  health.latency_median = 11.2;
  health.latency_p99 = 16.9;
  health.skipped = 3;
  health.lost = 12345;
  health.damaged = 7;
  health.resident = 42 << 20;
  health.version = "1.2";
  health.configuration = "cafe";
  health.calibration = "fits";
  return health;
}

std::string textOf(const HealthBoard& board, Clock::time_point now, int columns = 80) {
  std::string text;
  for (const BoardLine& line : board.table(now, columns)) text += line.text + "\n";
  return text;
}

TEST(HealthBoard, HasOneLineAProcessInTheOrderOfTheWork) {
  HealthBoard board;
  board.onHealth(healthOf("redbee-motion-segmentation", HealthState::kGood, 4), kNow);
  board.onHealth(healthOf("redbee-imu-integration", HealthState::kGood, 1), kNow);
  board.onHealth(healthOf("redbee-record", HealthState::kGood, 5), kNow);
  const auto lines = board.table(kNow);
  EXPECT_THAT(lines[1].text, HasSubstr("imu-integration"));
  EXPECT_THAT(lines[2].text, HasSubstr("visual-homography   no messages"));
  EXPECT_EQ(lines[2].tone, Tone::kBad);
  EXPECT_THAT(lines[4].text, HasSubstr("motion-segmentation"));
  EXPECT_THAT(lines[kStages.size() + 1].text, HasSubstr("record"));
  for (const char* part : {"good", "24.0", "23.5", "11.2", "16.9", " 3 ", "12k", " 7 ", " 42"}) {
    EXPECT_THAT(lines[1].text, HasSubstr(part));
  }
  EXPECT_THAT(textOf(board, kNow), HasSubstr("version 1.2, configuration cafe"));
}

TEST(HealthBoard, ReportsSinceWhenAProcessIsSilent) {
  HealthBoard board;
  board.onHealth(healthOf("redbee-visual-homography", HealthState::kGood), kNow);
  EXPECT_EQ(board.good(kNow + seconds(2)), 1) << "one missed message is no silence";
  EXPECT_EQ(board.good(kNow + seconds(7)), 0);
  EXPECT_THAT(textOf(board, kNow + seconds(7)), HasSubstr("visual-homography: silent since 7 s"));
  EXPECT_EQ(board.table(kNow + seconds(7))[2].tone, Tone::kBad);
}

TEST(HealthBoard, AStoppedOrDeadProcessIsNotSilent) {
  HealthBoard board;
  board.onHealth(healthOf("redbee-imu-integration", HealthState::kStopping), kNow);
  board.onHealth(healthOf("redbee-visual-homography", HealthState::kDead), kNow);
  auto script = healthOf("redbee-record", HealthState::kGood);
  script.configuration.clear();
  board.onHealth(script, kNow);
  EXPECT_THAT(textOf(board, kNow + seconds(60)), testing::Not(HasSubstr("silent")));
  EXPECT_EQ(board.table(kNow)[2].tone, Tone::kBad);
}

TEST(HealthBoard, ANewProcessNumberIsARestart) {
  HealthBoard board;
  board.onHealth(healthOf("redbee-imu-integration", HealthState::kGood, 10), kNow);
  board.onHealth(healthOf("redbee-imu-integration", HealthState::kDead, 10), kNow + seconds(1));
  board.onHealth(healthOf("redbee-imu-integration", HealthState::kStarting, 11), kNow + seconds(2));
  board.onHealth(healthOf("redbee-imu-integration", HealthState::kGood, 11), kNow + seconds(3));
  EXPECT_THAT(textOf(board, kNow + seconds(4)),
              HasSubstr("imu-integration: restarts seen: 1, the last 2 s ago"));
}

TEST(HealthBoard, DifferentBuildsOrConfigurationsStandOut) {
  HealthBoard board;
  board.onHealth(healthOf("redbee-imu-integration", HealthState::kGood), kNow);
  auto other = healthOf("redbee-visual-homography", HealthState::kGood);
  other.configuration = "beef";
  board.onHealth(other, kNow);
  const auto lines = board.table(kNow);
  EXPECT_EQ(lines.back().tone, Tone::kWarning);
  EXPECT_THAT(textOf(board, kNow), HasSubstr("configuration beef"));
}

TEST(HealthBoard, FitsTheTerminalAndRemovesControlCharacters) {
  HealthBoard board;
  auto wild = healthOf("redbee-motion-segmentation", HealthState::kDegraded, 4194304);
  wild.message = std::string(500, 'm') + "\x1b[2J";
  wild.rate_in = 1e6;
  wild.latency_p99 = 1e7;
  wild.skipped = wild.lost = wild.damaged = 1'000'000'000'000;
  wild.calibration = "does not fit\x1b]0;owned\x07";
  board.onHealth(wild, kNow);
  EXPECT_EQ(board.processes(), 1);
  for (const BoardLine& line : board.table(kNow)) {
    EXPECT_LE(line.text.size(), 80u);
    EXPECT_EQ(line.text.find('\x1b'), std::string::npos);
  }
}

TEST(HealthBoard, ARemarkThatIsTooLongForALineIsShownToItsEnd) {
  HealthBoard board;
  auto health = healthOf("redbee-geolocation", HealthState::kDegraded);
  health.message =
      "DETECTIONS are of another camera: a box ends at 285,232 px, configured is an image of 260x240";
  board.onHealth(health, kNow);
  EXPECT_THAT(textOf(board, kNow),
              HasSubstr("geolocation: DETECTIONS are of another camera: a box ends at 285,232 px,\n"
                        "  configured is an image of 260x240\n"));
}

TEST(HealthBoard, NamesOutsideTheProcessTableAreCountedNotKept) {
  HealthBoard board;
  board.onHealth(healthOf("redbee-imu-integration", HealthState::kGood), kNow);
  const size_t lines = board.table(kNow).size();
  for (int i = 0; i < 1200; ++i)
    board.onHealth(healthOf("invented" + std::to_string(i), HealthState::kGood), kNow);
  EXPECT_EQ(board.processes(), 1);
  EXPECT_EQ(board.table(kNow).size(), lines + 1);
  EXPECT_THAT(textOf(board, kNow), HasSubstr("1200 messages of names outside the process table"));
}

TEST(HealthBoard, ImplausibleMessagesAreCountedNotShown) {
  const auto isShown = [](const auto& change) {
    HealthBoard board;
    auto health = healthOf("redbee-imu-integration", HealthState::kGood);
    change(health);
    board.onHealth(health, kNow);
    EXPECT_EQ(board.processes() == 0,
              textOf(board, kNow).find("1 messages that no process") != std::string::npos);
    return board.processes() == 1;
  };
  EXPECT_TRUE(isShown([](auto&) {}));
  EXPECT_FALSE(isShown([](auto& h) { h.lost = 9'000'000'000'000'000'000; }));
  EXPECT_FALSE(isShown([](auto& h) { h.received = -1; }));
  EXPECT_FALSE(isShown([](auto& h) { h.pid = 0; }));
  EXPECT_FALSE(isShown([](auto& h) { h.state = 99; }));
  EXPECT_FALSE(isShown([](auto& h) { h.rate_in = std::numeric_limits<double>::quiet_NaN(); }));
  EXPECT_FALSE(isShown([](auto& h) { h.latency_p99 = -1e300; }));
  EXPECT_FALSE(isShown([](auto& h) { h.resident = std::numeric_limits<int64_t>::max(); }));
  EXPECT_FALSE(isShown([](auto& h) { h.message = std::string(100000, 'm'); }));
}

TEST(HealthBoard, ARecorderThatWasStoppedIsNotDead) {
  HealthBoard board;
  for (const char* name : {"redbee-record", "redbee-homography-fusion"}) {
    process_health_t death = healthOf(name, HealthState::kDead);
    death.message = "stopped, process 100";
    board.onHealth(death, kNow);
  }
  process_health_t died = healthOf("redbee-visual-homography", HealthState::kDead);
  died.message = "died, process 100";
  board.onHealth(died, kNow);
  for (const auto& process : board.list(kNow + seconds(60))) {
    const bool is_recorder = process.name == "record";
    if (is_recorder || process.name == "homography-fusion") {
      EXPECT_EQ(process.state, "stopped");
      EXPECT_EQ(process.tone, is_recorder ? Tone::kPlain : Tone::kWarning) << process.name;
    } else if (process.name == "visual-homography") {
      EXPECT_EQ(process.state, "dead");
      EXPECT_EQ(process.tone, Tone::kBad);
    }
  }
}

}  // namespace
}  // namespace redbee
