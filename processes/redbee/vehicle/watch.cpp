#include "processes/redbee/vehicle/watch.hpp"

#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <utility>

#include "processes/health_check.hpp"
#include "processes/redbee/vehicle/pidfd.hpp"
#include "redbee/node/health.hpp"

namespace redbee {
namespace {

constexpr std::chrono::milliseconds kWatchLate{500};

}  // namespace

ProcessWatch::ProcessWatch(Options options, AskSupervisor ask)
    : options_(std::move(options)), ask_(std::move(ask)) {}

ProcessWatch::~ProcessWatch() {
  for (auto& [name, watched] : watched_) {
    if (watched.fd >= 0) close(watched.fd);
  }
}

void ProcessWatch::refresh(Clock::time_point now) {
  const auto processes = ask_();
  if (!processes) return;
  for (const SupervisedProcess& process : *processes) {
    if (process.is_up && options_.programs.count(process.name) > 0) watch(process, now);
  }
  // What supervisor itself stops has all the time that supervisor gives it.
  for (auto& [name, watched] : watched_) {
    const auto is_same = [&, n = name, pid = watched.pid](const SupervisedProcess& process) {
      return process.is_up && process.name == n && process.pid == pid;
    };
    const bool is_up = std::any_of(processes->begin(), processes->end(), is_same);
    if (!is_up) watched.deadline = std::max(watched.deadline, now + hangTimeout());
  }
}

void ProcessWatch::watch(const SupervisedProcess& process, Clock::time_point now) {
  Watched& watched = watched_[process.name];
  if (watched.fd >= 0 && watched.pid == process.pid) return;
  const int fd = pidfd::open(process.pid);
  const auto identity = identityOf(process.pid);  // after the pidfd: of that process or of none
  if (fd < 0 || !identity || identity->parent != options_.supervisor) {
    if (fd >= 0) close(fd);
    return;
  }
  if (watched.fd >= 0) noteDeath(process.name, watched);
  watched = {fd, process.pid, identity->start_ticks, now + hangTimeout(), false, {}, {}};
  watched.silence.end(now);
  watched.deadline = std::max(watched.deadline, now - identity->age + kStartTimeout);
}

bool ProcessWatch::onHeartbeat(pid_t pid, Clock::time_point now) {
  for (auto& [name, watched] : watched_) {
    if (watched.fd < 0 || watched.pid != pid) continue;
    watched.deadline = now + hangTimeout();
    watched.silence.end(now);
    return true;
  }
  return false;
}

void ProcessWatch::onHealth(const process_health_t& health) {
  if (health.state == static_cast<int8_t>(HealthState::kDead)) return;
  for (auto& [name, watched] : watched_) {
    if (watched.pid != health.pid || health.process != "redbee-" + name || !isPlausible(health)) continue;
    watched.last = health;
    return;
  }
  ++strangers_;
}

bool ProcessWatch::isStillWatched(const std::string& name, const Watched& watched) const {
  const auto identity = identityOf(watched.pid);
  if (!identity || identity->parent != options_.supervisor || identity->start_ticks != watched.start_ticks)
    return false;
  std::error_code error;
  if (!std::filesystem::equivalent(identity->executable, options_.programs.at(name), error)) return false;
  const auto processes = ask_();
  return processes &&
         std::any_of(processes->begin(), processes->end(), [&](const SupervisedProcess& process) {
           return process.is_up && process.name == name && process.pid == watched.pid;
         });
}

std::vector<std::string> ProcessWatch::killHanging(Clock::time_point now) {
  const auto period = last_look_ ? now - *last_look_ : Clock::duration::zero();
  // Who was itself not scheduled cannot tell how long the others were silent.
  const bool is_late = period > kWatchLate;
  last_look_ = now;
  std::vector<std::string> killed;
  for (auto& [name, watched] : watched_) {
    if (watched.fd < 0) continue;
    const auto waited = watched.silence.waited(watched.pid, now, period);
    watched.deadline += is_late ? period : waited;
    if (now < watched.deadline) continue;
    watched.deadline = now + hangTimeout();
    if (!isStillWatched(name, watched) || !pidfd::send(watched.fd, SIGKILL)) continue;
    watched.killed = true;
    killed.push_back(name);
  }
  return killed;
}

void ProcessWatch::noteDeath(const std::string& name, Watched& watched) {
  const bool was_stopping = watched.last.state == static_cast<int8_t>(HealthState::kStopping);
  process_health_t death = watched.last;
  death.process = "redbee-" + name;
  death.pid = watched.pid;
  death.state = static_cast<int8_t>(HealthState::kDead);
  death.message = (watched.killed ? "hung and was killed, process "
                   : was_stopping ? kStopped
                                  : "died, process ") +
                  std::to_string(death.pid);
  death.rate_in = death.rate_out = 0;
  death.resident = 0;
  deaths_.push_back(std::move(death));
  close(watched.fd);
  watched.fd = -1;
}

std::vector<process_health_t> ProcessWatch::drainDeaths() {
  for (auto& [name, watched] : watched_) {
    if (watched.fd >= 0 && pidfd::hasEnded(watched.fd)) noteDeath(name, watched);
  }
  return std::exchange(deaths_, {});
}

}  // namespace redbee
