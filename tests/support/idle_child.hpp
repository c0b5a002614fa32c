// A child process that does nothing, so that a test may end it.
#pragma once

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <string>

namespace redbee::test {

class IdleChild {
 public:
  IdleChild() : pid_(fork()) {
    if (pid_ == 0) {
      while (true) pause();
    }
    for (int ms = 0; ms < 60'000 && !isAsleep(); ++ms) usleep(1000);
  }
  ~IdleChild() {
    ::kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  IdleChild(const IdleChild&) = delete;
  IdleChild& operator=(const IdleChild&) = delete;

  int pid() const { return pid_; }
  /// It stays a zombie until the end of the test, so that its number is not used again.
  void kill() const {
    ::kill(pid_, SIGKILL);
    awaitDeath();
  }
  void awaitDeath() const {
    siginfo_t info{};
    waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOWAIT);
  }
  bool hasEnded() const {
    siginfo_t info{};
    return waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
           info.si_pid == pid_;
  }

 private:
  /// Before it has come to its pause it waits for a processor, which a test in simulated time would see.
  bool isAsleep() const {
    std::ifstream file("/proc/" + std::to_string(pid_) + "/stat");
    std::string text;
    return std::getline(file, text) && text.find(") S ") != std::string::npos;
  }

  int pid_;
};

}  // namespace redbee::test
