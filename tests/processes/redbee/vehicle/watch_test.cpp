#include "processes/redbee/vehicle/watch.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <filesystem>

#include "redbee/node/health.hpp"
#include "tests/support/idle_child.hpp"

namespace redbee {
namespace {

using Clock = ProcessWatch::Clock;
using std::chrono::milliseconds;
using std::chrono::seconds;
using test::IdleChild;

const std::string kName = "imu-integration";
const std::string kOther = "homography-fusion";

process_health_t healthOf(const std::string& process, int pid, HealthState state = HealthState::kGood) {
  process_health_t health{};
  health.process = "redbee-" + process;
  health.pid = pid;
  health.state = static_cast<int8_t>(state);
  health.rate_in = 24;
  return health;
}

/// A watch over children of this test, which takes the part of supervisor.
class ProcessWatchTest : public testing::Test {
 protected:
  void refresh() { watch_.refresh(start_); }
  /// After the time that a process has to start.
  Clock::time_point settled() const { return start_ + ProcessWatch::kStartTimeout + seconds(1); }
  /// Looks several times a second, as the watch does, until 1 s later.
  std::vector<std::string> killedUntil(Clock::time_point end) {
    std::vector<std::string> killed;
    for (auto now = start_; now <= end; now += milliseconds(100)) {
      if (alive_ != nullptr) watch_.onHeartbeat(alive_->pid(), now);
      for (const std::string& name : watch_.killHanging(now)) killed.push_back(name);
    }
    return killed;
  }

  Clock::time_point start_ = Clock::now();
  pid_t supervisor_ = getpid();
  std::filesystem::path program_ = std::filesystem::read_symlink("/proc/self/exe");
  std::optional<std::vector<SupervisedProcess>> supervised_ = std::vector<SupervisedProcess>{};
  const IdleChild* alive_ = nullptr;
  ProcessWatch watch_{{supervisor_, {{kName, program_}, {kOther, program_}}, seconds(2)},
                      [this] { return supervised_; }};
};

TEST_F(ProcessWatchTest, ADeathIsReportedOnceUnderTheProcessName) {
  IdleChild child;
  supervised_ = {{kName, child.pid(), true}};
  refresh();
  watch_.onHealth(healthOf(kName, child.pid()));
  EXPECT_TRUE(watch_.drainDeaths().empty());
  child.kill();
  const auto deaths = watch_.drainDeaths();
  ASSERT_EQ(deaths.size(), 1u);
  EXPECT_EQ(deaths[0].process, "redbee-" + kName);
  EXPECT_EQ(deaths[0].pid, child.pid());
  EXPECT_EQ(deaths[0].state, static_cast<int8_t>(HealthState::kDead));
  EXPECT_EQ(deaths[0].rate_in, 0);
  EXPECT_THAT(deaths[0].message, testing::HasSubstr("died"));
  EXPECT_TRUE(watch_.drainDeaths().empty());
}

TEST_F(ProcessWatchTest, AStoppingProcessHasNotDied) {
  IdleChild child;
  supervised_ = {{kName, child.pid(), true}};
  refresh();
  watch_.onHealth(healthOf(kName, child.pid(), HealthState::kStopping));
  child.kill();
  const auto deaths = watch_.drainDeaths();
  ASSERT_EQ(deaths.size(), 1u);
  EXPECT_THAT(deaths[0].message, testing::HasSubstr("stopped"));
}

TEST_F(ProcessWatchTest, ARestartedProcessIsWatchedAgain) {
  IdleChild first;
  IdleChild second;
  supervised_ = {{kName, first.pid(), true}};
  refresh();
  first.kill();
  supervised_ = {{kName, second.pid(), true}};
  refresh();
  EXPECT_EQ(watch_.drainDeaths().size(), 1u);
  second.kill();
  EXPECT_EQ(watch_.drainDeaths().size(), 1u);
}

TEST_F(ProcessWatchTest, AProcessWithoutHeartbeatIsKilledWhileAnotherLives) {
  IdleChild hanging;
  IdleChild living;
  alive_ = &living;
  supervised_ = {{kName, hanging.pid(), true}, {kOther, living.pid(), true}};
  refresh();
  EXPECT_TRUE(watch_.onHeartbeat(hanging.pid(), start_));
  EXPECT_TRUE(killedUntil(start_ + milliseconds(1900)).empty());
  EXPECT_THAT(watch_.killHanging(start_ + milliseconds(2000)), testing::ElementsAre(kName));
  hanging.awaitDeath();
  EXPECT_FALSE(living.hasEnded());
  const auto deaths = watch_.drainDeaths();
  ASSERT_EQ(deaths.size(), 1u);
  EXPECT_THAT(deaths[0].message, testing::HasSubstr("hung"));
}

TEST_F(ProcessWatchTest, AProcessMayTakeLongToStart) {
  IdleChild child;
  supervised_ = {{kName, child.pid(), true}};
  refresh();
  EXPECT_TRUE(killedUntil(start_ + ProcessWatch::kStartTimeout - seconds(2)).empty());
  EXPECT_THAT(killedUntil(settled()), testing::ElementsAre(kName));
}

TEST_F(ProcessWatchTest, AWatchThatWasNotScheduledBlamesNobody) {
  IdleChild child;
  supervised_ = {{kName, child.pid(), true}};
  refresh();
  watch_.onHeartbeat(child.pid(), start_);
  watch_.killHanging(start_);
  EXPECT_TRUE(watch_.killHanging(start_ + seconds(60)).empty());
}

TEST_F(ProcessWatchTest, WhatAMessageNamesIsNeitherKilledNorKept) {
  IdleChild unrelated;
  watch_.onHealth(healthOf(kName, unrelated.pid()));
  watch_.onHealth(healthOf(kOther, supervisor_));
  for (int i = 0; i < 1200; ++i) watch_.onHealth(healthOf("invented" + std::to_string(i), unrelated.pid()));
  EXPECT_TRUE(killedUntil(settled()).empty());
  EXPECT_FALSE(unrelated.hasEnded());
  EXPECT_EQ(watch_.strangers(), 1202);
  unrelated.kill();
  EXPECT_TRUE(watch_.drainDeaths().empty());
}

TEST_F(ProcessWatchTest, AMessageThatNoProcessCanHaveSentIsNotKept) {
  IdleChild child;
  supervised_ = {{kName, child.pid(), true}};
  refresh();
  process_health_t wild = healthOf(kName, child.pid());
  wild.lost = 9'000'000'000'000'000'000;
  watch_.onHealth(wild);
  EXPECT_EQ(watch_.strangers(), 1);
  child.kill();
  EXPECT_EQ(watch_.drainDeaths().at(0).lost, 0);
}

TEST_F(ProcessWatchTest, NothingIsKilledUnlessSupervisorAgrees) {
  IdleChild child;
  const std::vector<std::optional<std::vector<SupervisedProcess>>> disagreements{
      std::nullopt,                        // no answer
      {{{kName, child.pid(), false}}},     // it is being stopped
      {{{kName, child.pid() + 1, true}}},  // another process by now
      {{{kOther, child.pid(), true}}},
      std::vector<SupervisedProcess>{},
  };
  for (const auto& disagreement : disagreements) {
    supervised_ = {{kName, child.pid(), true}};
    refresh();
    supervised_ = disagreement;
    EXPECT_TRUE(killedUntil(settled()).empty());
    EXPECT_FALSE(child.hasEnded());
  }
}

TEST_F(ProcessWatchTest, OnlyTheExpectedProgramIsKilled) {
  IdleChild child;
  program_ = "/bin/sh";
  ProcessWatch watch({supervisor_, {{kName, program_}}, seconds(2)}, [this] { return supervised_; });
  supervised_ = {{kName, child.pid(), true}};
  watch.refresh(start_);
  for (auto now = start_; now < settled(); now += milliseconds(100))
    EXPECT_TRUE(watch.killHanging(now).empty());
  EXPECT_FALSE(child.hasEnded());
}

TEST_F(ProcessWatchTest, OnlyChildrenOfSupervisorAreWatched) {
  ProcessWatch watch({supervisor_, {{kName, program_}}, seconds(2)}, [this] { return supervised_; });
  supervised_ = {{kName, getppid(), true}};  // as a forged or confused answer would say
  watch.refresh(start_);
  EXPECT_FALSE(watch.onHeartbeat(getppid(), start_));
}

}  // namespace
}  // namespace redbee
