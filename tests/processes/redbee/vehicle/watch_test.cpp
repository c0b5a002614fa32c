#include "processes/redbee/vehicle/watch.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <thread>

#include "redbee/node/health.hpp"

namespace redbee {
namespace {

using Clock = ProcessWatch::Clock;
using std::chrono::seconds;

/// A child that does nothing, so that a test may end it.
class Child {
 public:
  Child() : pid_(fork()) {
    if (pid_ == 0) {
      while (true) pause();
    }
  }
  ~Child() {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  int pid() const { return pid_; }
  bool isZombie() const {
    siginfo_t info{};
    return waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
           info.si_pid == pid_;
  }
  void awaitDeath() const {
    siginfo_t info{};
    waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOWAIT);
  }

 private:
  int pid_;
};

process_health_t healthOf(const std::string& process, int pid, HealthState state = HealthState::kGood) {
  process_health_t health{};
  health.process = process;
  health.pid = pid;
  health.state = static_cast<int8_t>(state);
  health.configuration = "cafe";
  health.rate_in = 24;
  return health;
}

TEST(ProcessWatch, ADeathIsReportedOnceUnderTheProcessName) {
  Child child;
  ProcessWatch watch;
  watch.onHealth(healthOf("redbee-a", child.pid()), Clock::now());
  EXPECT_TRUE(watch.drainDeaths().empty());
  kill(child.pid(), SIGKILL);
  child.awaitDeath();
  const auto deaths = watch.drainDeaths();
  ASSERT_EQ(deaths.size(), 1u);
  EXPECT_EQ(deaths[0].process, "redbee-a");
  EXPECT_EQ(deaths[0].pid, child.pid());
  EXPECT_EQ(deaths[0].state, static_cast<int8_t>(HealthState::kDead));
  EXPECT_EQ(deaths[0].rate_in, 0);
  EXPECT_THAT(deaths[0].message, testing::HasSubstr("died"));
  EXPECT_TRUE(watch.drainDeaths().empty());
}

TEST(ProcessWatch, AStoppingProcessHasNotDied) {
  Child child;
  ProcessWatch watch;
  watch.onHealth(healthOf("redbee-a", child.pid(), HealthState::kStopping), Clock::now());
  kill(child.pid(), SIGTERM);
  child.awaitDeath();
  const auto deaths = watch.drainDeaths();
  ASSERT_EQ(deaths.size(), 1u);
  EXPECT_THAT(deaths[0].message, testing::HasSubstr("stopped"));
}

TEST(ProcessWatch, ARestartedProcessIsWatchedAgain) {
  Child first;
  Child second;
  ProcessWatch watch;
  watch.onHealth(healthOf("redbee-a", first.pid()), Clock::now());
  watch.onHealth(healthOf("redbee-a", second.pid()), Clock::now());
  kill(first.pid(), SIGKILL);
  first.awaitDeath();
  EXPECT_TRUE(watch.drainDeaths().empty()) << "the first is no longer the process of this name";
  kill(second.pid(), SIGKILL);
  second.awaitDeath();
  EXPECT_EQ(watch.drainDeaths().size(), 1u);
}

TEST(ProcessWatch, AHangingProcessIsKilledWhileOthersPublish) {
  Child hanging;
  Child publishing;
  ProcessWatch watch;
  const auto start = Clock::now();
  watch.onHealth(healthOf("redbee-hanging", hanging.pid()), start);
  watch.onHealth(healthOf("redbee-publishing", publishing.pid()),
                 start + ProcessWatch::kHangTimeout - seconds(1));
  EXPECT_TRUE(watch.killHanging(start + ProcessWatch::kHangTimeout - seconds(1)).empty());
  EXPECT_THAT(watch.killHanging(start + ProcessWatch::kHangTimeout), testing::ElementsAre("redbee-hanging"));
  hanging.awaitDeath();
  EXPECT_FALSE(publishing.isZombie());
}

TEST(ProcessWatch, NothingIsKilledWhileNobodyPublishes) {
  Child a;
  ProcessWatch watch;
  const auto start = Clock::now();
  watch.onHealth(healthOf("redbee-a", a.pid()), start);
  EXPECT_TRUE(watch.killHanging(start + seconds(60)).empty()) << "the network is gone, not the process";
  EXPECT_FALSE(a.isZombie());
}

TEST(ProcessWatch, AScriptMayBeSilent) {
  Child script;
  Child other;
  ProcessWatch watch;
  const auto start = Clock::now();
  auto recording = healthOf("redbee-record", script.pid());
  recording.configuration.clear();
  watch.onHealth(recording, start);
  watch.onHealth(healthOf("redbee-other", other.pid()), start + seconds(60));
  EXPECT_TRUE(watch.killHanging(start + seconds(60)).empty());
}

TEST(ProcessWatch, AProcessOfAnotherHostIsLeftAlone) {
  ProcessWatch watch;
  constexpr int kNobody = 0x3ffffff;  // above any pid_max
  watch.onHealth(healthOf("redbee-elsewhere", kNobody), Clock::now());
  EXPECT_TRUE(watch.drainDeaths().empty());
}

}  // namespace
}  // namespace redbee
