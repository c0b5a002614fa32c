// Processes that use a processor, for tests of who waits for it.
#pragma once

#include <sched.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace redbee::test {

/// Computes on the first processor that it may use.
[[noreturn]] inline void computeForEver(int policy) {
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

/// A child that does.
class BusyChild {
 public:
  explicit BusyChild(int policy) : pid_(fork()) {
    if (pid_ != 0) return;
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    computeForEver(policy);
  }
  ~BusyChild() {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  BusyChild(const BusyChild&) = delete;
  BusyChild& operator=(const BusyChild&) = delete;
  pid_t pid() const { return pid_; }
  void letRun() const {
    const sched_param none{};
    sched_setscheduler(pid_, SCHED_OTHER, &none);
  }

 private:
  pid_t pid_;
};

}  // namespace redbee::test
