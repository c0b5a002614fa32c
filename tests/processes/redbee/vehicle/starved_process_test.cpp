// A process that is silent because others have the processor does not hang; one that uses it and is silent
// does.
#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <thread>

#include "processes/redbee/vehicle/watch.hpp"
#include "tests/support/busy_child.hpp"

namespace redbee::test {
namespace {

using Clock = ProcessWatch::Clock;

constexpr std::chrono::milliseconds kPeriod{20};
constexpr std::chrono::milliseconds kTimeout{1000};
const std::string kName = "serve";

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
  starved.letRun();
  EXPECT_TRUE(killedWithin(100 * kTimeout)) << "it computes and is silent";
}

}  // namespace
}  // namespace redbee::test
