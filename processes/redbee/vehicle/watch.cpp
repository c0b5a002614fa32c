#include "processes/redbee/vehicle/watch.hpp"

#include <poll.h>
#include <signal.h>
extern "C" {
#include <sys/pidfd.h>  // glibc 2.36 declares these without C linkage
}
#include <unistd.h>

#include <cstdio>
#include <utility>

#include "redbee/configuration/configuration.hpp"
#include "redbee/node/health.hpp"
#include "redbee/node/node.hpp"

namespace redbee {
namespace {

constexpr std::chrono::milliseconds kPeriod{20};
constexpr std::chrono::milliseconds kWaking{500};

bool hasEnded(int fd) {
  pollfd entry{fd, POLLIN, 0};
  return poll(&entry, 1, 0) > 0;
}

}  // namespace

ProcessWatch::~ProcessWatch() {
  for (auto& [process, watched] : watched_) stopWatching(watched);
}

void ProcessWatch::stopWatching(Watched& watched) {
  if (watched.fd >= 0) close(watched.fd);
  watched.fd = -1;
}

void ProcessWatch::onHealth(const process_health_t& health, Clock::time_point now) {
  if (health.state == static_cast<int8_t>(HealthState::kDead)) return;
  Watched& watched = watched_[health.process];
  if (watched.fd < 0 || health.pid != watched.last.pid) {
    stopWatching(watched);
    watched.fd = pidfd_open(health.pid, 0);
  }
  watched.last = health;
  watched.received = now;
  if (!health.configuration.empty()) newest_message_ = now;
}

std::vector<std::string> ProcessWatch::killHanging(Clock::time_point now) {
  // Without messages from any process the network is down, and killing processes would not restore it.
  constexpr std::chrono::seconds kNetworkIsUp{2};
  std::vector<std::string> killed;
  if (newest_message_ == Clock::time_point::min() || now - newest_message_ > kNetworkIsUp) return killed;
  for (auto& [process, watched] : watched_) {
    if (watched.fd < 0 || watched.last.configuration.empty() || now - watched.received < kHangTimeout)
      continue;
    if (pidfd_send_signal(watched.fd, SIGKILL, nullptr, 0) == 0) killed.push_back(process);
    watched.received = now;
  }
  return killed;
}

std::vector<process_health_t> ProcessWatch::drainDeaths() {
  std::vector<process_health_t> deaths;
  for (auto& [process, watched] : watched_) {
    if (watched.fd < 0 || !hasEnded(watched.fd)) continue;
    stopWatching(watched);
    const bool was_stopping = watched.last.state == static_cast<int8_t>(HealthState::kStopping);
    process_health_t death = watched.last;
    death.state = static_cast<int8_t>(HealthState::kDead);
    death.message = (was_stopping ? "stopped, process " : "died, process ") + std::to_string(death.pid);
    death.rate_in = death.rate_out = 0;
    death.resident = 0;
    deaths.push_back(std::move(death));
  }
  return deaths;
}

void runWatch(const WatchOptions& options) {
  const std::string channel = loadConfiguration(options.configuration).channels.health;
  const auto bus = makeLcmBus(options.url);
  ProcessWatch watch;
  const Subscription subscription = bus->subscribe<process_health_t>(
      channel, kListenerQueue,
      [&](const process_health_t& health) { watch.onHealth(health, ProcessWatch::Clock::now()); }, nullptr);
  const std::atomic<bool>& stop = stopOnSignals();
  auto wake_until = ProcessWatch::Clock::time_point::min();
  while (!stop) {
    bus->handle(kPeriod);
    for (const std::string& process : watch.killHanging(ProcessWatch::Clock::now())) {
      std::printf("%s has published nothing for %lld s: killed\n", process.c_str(),
                  static_cast<long long>(ProcessWatch::kHangTimeout.count()));
    }
    for (const process_health_t& death : watch.drainDeaths()) {
      std::printf("%s %s\n", death.process.c_str(), death.message.c_str());
      bus->publish(channel, death);
      wake_until = ProcessWatch::Clock::now() + kWaking;
    }
    if (ProcessWatch::Clock::now() < wake_until) std::printf("waking supervisor\n");
    std::fflush(stdout);
  }
}

}  // namespace redbee
