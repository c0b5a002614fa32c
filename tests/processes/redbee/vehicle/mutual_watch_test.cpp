#include "processes/redbee/vehicle/mutual_watch.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <stdexcept>
#include <thread>

#include "tests/support/busy_child.hpp"

namespace redbee {
namespace {

using std::chrono::milliseconds;
constexpr milliseconds kTimeout{600};

/// Runs the pair in a child of the test, as its parent's half returns only when the other ends. Returns the
/// exit status.
template <typename Work>
int statusOfPair(const Work& work) {
  const pid_t guard = fork();
  if (guard == 0) {
    try {
      const pid_t self = getpid();
      const int status = watchEachOther(kTimeout, work);
      _exit(getpid() == self ? status : 0);
    } catch (const std::runtime_error&) {
      _exit(7);
    }
  }
  int status = 0;
  waitpid(guard, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

void liveFor(Partner& partner, milliseconds time) {
  const auto end = Partner::Clock::now() + time;
  while (Partner::Clock::now() < end && partner.exchange(Partner::Clock::now()) == Partner::State::kAlive)
    usleep(20'000);
}

TEST(MutualWatch, EndsWithTheWorkersStatus) {
  EXPECT_EQ(statusOfPair([](Partner& partner) {
              liveFor(partner, 3 * kTimeout);
              _exit(5);
            }),
            5);
}

TEST(MutualWatch, AHangingWorkerIsKilled) {
  EXPECT_EQ(statusOfPair([](Partner& partner) {
              liveFor(partner, milliseconds(100));
              while (true) pause();
            }),
            7);
}

TEST(MutualWatch, AWorkerThatOthersKeepFromTheProcessorIsNotKilled) {
  const auto start = Partner::Clock::now();
  const pid_t others = fork();
  if (others == 0) {
    {
      const test::BusyChild first(SCHED_OTHER), second(SCHED_OTHER);
      std::this_thread::sleep_for(6 * kTimeout);
    }
    _exit(0);
  }
  EXPECT_EQ(statusOfPair([](Partner& partner) {
              liveFor(partner, milliseconds(100));
              test::computeForEver(SCHED_IDLE);
            }),
            7);
  EXPECT_GT(Partner::Clock::now() - start, 6 * kTimeout) << "killed while others had the processor";
  waitpid(others, nullptr, 0);
}

TEST(MutualWatch, AHangingGuardIsKilled) {
  EXPECT_EQ(statusOfPair([](Partner& partner) {
              liveFor(partner, milliseconds(100));
              kill(getppid(), SIGSTOP);
              while (partner.exchange(Partner::Clock::now()) == Partner::State::kAlive) usleep(20'000);
              partner.end();
              _exit(0);
            }),
            128 + SIGKILL);
}

TEST(MutualWatch, AWorkerWithoutItsGuardEnds) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  statusOfPair([&](Partner& partner) {
    signal(SIGTERM, SIG_IGN);  // of the guard's death; the pair must notice by itself
    liveFor(partner, milliseconds(100));
    kill(getppid(), SIGKILL);
    while (partner.exchange(Partner::Clock::now()) == Partner::State::kAlive) usleep(20'000);
    static_cast<void>(write(ends[1], ".", 1));
    _exit(0);
  });
  close(ends[1]);
  char sign = 0;
  EXPECT_EQ(read(ends[0], &sign, 1), 1) << "the worker did not notice";
  close(ends[0]);
}

}  // namespace
}  // namespace redbee
