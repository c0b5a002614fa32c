// A process that is silent because others have the processor does not hang; one that uses it and is silent
// does.
#include <gmock/gmock.h>
#include <sched.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <thread>

#include "processes/redbee/vehicle/watch.hpp"

namespace redbee::test {
namespace {

using Clock = ProcessWatch::Clock;

constexpr std::chrono::milliseconds kPeriod{20};
constexpr std::chrono::milliseconds kTimeout{1000};
const std::string kName = "serve";

/// Computes on the first processor that it may use.
class BusyChild {
 public:
  explicit BusyChild(int policy) : pid_(fork()) {
    if (pid_ != 0) return;
    cpu_set_t all, one;
    CPU_ZERO(&one);
    sched_getaffinity(0, sizeof all, &all);
    for (int i = 0; i < CPU_SETSIZE; ++i) {
      if (!CPU_ISSET(i, &all)) continue;
      CPU_SET(i, &one);
      break;
    }
    const sched_param none{};
    if (sched_setaffinity(0, sizeof one, &one) != 0 || sched_setscheduler(0, policy, &none) != 0) _exit(1);
    for (volatile unsigned spins = 0;; ++spins) {
    }
  }
  ~BusyChild() {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  BusyChild(const BusyChild&) = delete;
  BusyChild& operator=(const BusyChild&) = delete;
  pid_t pid() const { return pid_; }

 private:
  pid_t pid_;
};

TEST(StarvedProcess, IsKilledOnlyOnceItHasHadTheProcessor) {
  const auto program = std::filesystem::read_symlink("/proc/self/exe");
  BusyChild starved(SCHED_IDLE);
  std::vector<SupervisedProcess> supervised{{kName, starved.pid(), true}};
  ProcessWatch watch({getpid(), {{kName, program}}, kTimeout}, [&] { return std::optional(supervised); });
  const auto killedWithin = [&](Clock::duration duration) {
    for (const auto end = Clock::now() + duration; Clock::now() < end; std::this_thread::sleep_for(kPeriod)) {
      if (!watch.killHanging(Clock::now()).empty()) return true;
    }
    return false;
  };
  {
    const BusyChild first(SCHED_OTHER), second(SCHED_OTHER);
    watch.refresh(Clock::now());
    watch.onHeartbeat(starved.pid(), Clock::now());
    EXPECT_FALSE(killedWithin(4 * kTimeout)) << "others have the processor";
  }
  EXPECT_TRUE(killedWithin(100 * kTimeout)) << "it computes and is silent";
}

}  // namespace
}  // namespace redbee::test
