#include "processes/redbee/vehicle/mutual_watch.hpp"

#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <utility>

#include "processes/redbee/vehicle/pidfd.hpp"
#include "redbee/node/node.hpp"

namespace redbee {
namespace {

constexpr std::chrono::milliseconds kSignPeriod{100};
constexpr std::chrono::milliseconds kPartnerLate{500};

int waitFor(pid_t child) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!WIFEXITED(status)) throw std::runtime_error("watch: its worker crashed or was killed");
  return WEXITSTATUS(status);
}

int guard(Partner& worker, pid_t child, int fd) {
  const std::atomic<bool>& stop = stopOnSignals();
  for (bool passed_on = false;;) {
    if (stop && !passed_on) {
      kill(child, SIGTERM);  // our own child, not waited for yet: its number is still its own
      passed_on = true;
    }
    switch (worker.exchange(Partner::Clock::now())) {
      case Partner::State::kGone:
        return waitFor(child);
      case Partner::State::kHung:
        std::fprintf(stderr, "watch: its worker hangs: killed\n");
        worker.end();
        return waitFor(child);
      case Partner::State::kAlive:
        break;
    }
    pollfd entry{fd, POLLIN, 0};
    poll(&entry, 1, static_cast<int>(kSignPeriod.count()));
  }
}

}  // namespace

Partner::Partner(int fd, const Process& partner, std::chrono::duration<double> timeout)
    : fd_(fd),
      partner_(partner),
      timeout_(std::chrono::duration_cast<Clock::duration>(timeout)),
      deadline_(Clock::now() + kStartTimeout),
      last_call_(Clock::now()) {
  silence_.end(last_call_);
}

Partner::~Partner() {
  close(fd_);
  close(partner_.pidfd);
}

Partner::State Partner::exchange(Clock::time_point now) {
  // Who was itself not scheduled cannot tell how long the other was silent.
  const auto period = now - std::exchange(last_call_, now);
  const auto waited = silence_.waited(partner_.pid, now, period);
  deadline_ += period > kPartnerLate ? period : waited;
  char signs[256];
  ssize_t count = 0;
  while ((count = recv(fd_, signs, sizeof signs, MSG_DONTWAIT)) > 0) {
    deadline_ = now + timeout_;
    silence_.end(now);
  }
  if (count == 0) return State::kGone;
  if (now >= next_) {
    next_ = now + kSignPeriod;
    // A full buffer means that the partner has not read for long: it will be found hung.
    if (send(fd_, ".", 1, MSG_DONTWAIT | MSG_NOSIGNAL) < 0 && errno == EPIPE) return State::kGone;
  }
  return now < deadline_ ? State::kAlive : State::kHung;
}

void Partner::end() const { pidfd::send(partner_.pidfd, SIGKILL); }

int watchEachOther(std::chrono::duration<double> timeout, const std::function<void(Partner&)>& work) {
  int ends[2];
  const pid_t parent = getpid();
  const int parent_fd = pidfd::open(parent);
  if (parent_fd < 0 || socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    throw std::runtime_error("watch: no pair of sockets");
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("watch: cannot fork");
  if (child == 0) {
    close(ends[0]);
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    Partner partner(ends[1], {parent, parent_fd}, timeout);
    work(partner);
    return 0;
  }
  close(ends[1]);
  close(parent_fd);
  Partner worker(ends[0], {child, pidfd::open(child)}, timeout);
  return guard(worker, child, ends[0]);
}

}  // namespace redbee
