// logs/recorded_0.1.lcm was recorded live by version 0.1.0: its sensors' messages must always replay, and its
// internal messages, whose types have changed since, must do no harm.
#include <gtest/gtest.h>

#include <set>

#include "redbee/configuration/process_table.hpp"
#include "redbee/files/log.hpp"
#include "tests/support/stack_run.hpp"

namespace redbee::test {
namespace {

constexpr int kRecordedFrames = 10;
const std::set<std::string> kSensors{"CAMERA", "IMU", "ALTIMETER"};
const std::set<std::string> kWithInternal{
    "CAMERA", "IMU", "ALTIMETER", "INERTIAL_HOMOGRAPHY", "VISUAL_HOMOGRAPHY", "FUSED_HOMOGRAPHY"};

StackFlight recorded(const std::set<std::string>& channels) {
  const std::filesystem::path root = REDBEE_SOURCE_DIR;
  StackFlight flight;
  flight.configuration = loadConfiguration(root / "config" / "park1.yaml");
  LogReader log(root / "logs" / "recorded_0.1.lcm");
  while (const std::optional<LogEvent> event = log.next()) {
    if (channels.count(event->channel) > 0)
      flight.messages.push_back({event->utime, event->channel, event->data});
  }
  return flight;
}

TEST(RecordedLog, EveryMessageOfTheSensorsIsTaken) {
  const StackOutput output = StackRun(recorded(kSensors)).run();
  EXPECT_EQ(output.foreground.size(), kRecordedFrames);
  EXPECT_EQ(output.foreground.rbegin()->second.status, foreground_t::GOOD);
  EXPECT_EQ(output.fused.rbegin()->second.source, fused_homography_t::FUSED);
  for (const auto& [name, health] : output.health) {
    EXPECT_EQ(health.damaged, 0) << name;
    EXPECT_GT(health.received, 0) << name;
  }
}

TEST(RecordedLog, OldInternalMessagesAreCountedAndChangeNothing) {
  const StackOutput expected = StackRun(recorded(kSensors)).run();
  const StackOutput output = StackRun(recorded(kWithInternal)).run();
  ASSERT_EQ(output.foreground.size(), expected.foreground.size());
  for (const auto& [utime, foreground] : expected.foreground) {
    EXPECT_EQ(output.foreground.at(utime).mask, foreground.mask);
    EXPECT_EQ(output.foreground.at(utime).status, foreground.status);
  }
  EXPECT_GT(output.health.at(programName(kHomographyFusion)).damaged, 0);
}

}  // namespace
}  // namespace redbee::test
