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

constexpr int kQueue = 256;
constexpr std::chrono::milliseconds kPeriod{20};
constexpr std::chrono::milliseconds kWaking{500};

bool hasEnded(int fd) {
  pollfd entry{fd, POLLIN, 0};
  return poll(&entry, 1, 0) > 0;
}

}  // namespace

ProcessWatch::~ProcessWatch() {
  for (auto& [process, watched] : watched_) forget(watched);
}

void ProcessWatch::forget(Watched& watched) {
  if (watched.fd >= 0) close(watched.fd);
  watched.fd = -1;
}

void ProcessWatch::hear(const process_health_t& health, Clock::time_point now) {
  if (health.state == static_cast<int8_t>(HealthState::kDead)) return;
  Watched& watched = watched_[health.process];
  if (watched.fd < 0 || health.pid != watched.last.pid) {
    forget(watched);
    watched.fd = pidfd_open(health.pid, 0);
  }
  watched.last = health;
  watched.heard = now;
  if (!health.configuration.empty()) anyone_heard_ = now;
}

std::vector<std::string> ProcessWatch::endHanging(Clock::time_point now) {
  // If nobody is heard it is the network that is gone, and killing everyone would not bring it back.
  constexpr std::chrono::seconds kSomeoneSpeaks{2};
  std::vector<std::string> ended;
  if (anyone_heard_ == Clock::time_point::min() || now - anyone_heard_ > kSomeoneSpeaks) return ended;
  for (auto& [process, watched] : watched_) {
    if (watched.fd < 0 || watched.last.configuration.empty() || now - watched.heard < kHangs) continue;
    if (pidfd_send_signal(watched.fd, SIGKILL, nullptr, 0) == 0) ended.push_back(process);
    watched.heard = now;
  }
  return ended;
}

std::vector<process_health_t> ProcessWatch::takeDeaths() {
  std::vector<process_health_t> deaths;
  for (auto& [process, watched] : watched_) {
    if (watched.fd < 0 || !hasEnded(watched.fd)) continue;
    forget(watched);
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
  bus->subscribe<process_health_t>(
      channel, kQueue,
      [&](const process_health_t& health) { watch.hear(health, ProcessWatch::Clock::now()); }, nullptr);
  const std::atomic<bool>& stop = stopOnSignals();
  auto wake_until = ProcessWatch::Clock::time_point::min();
  while (!stop) {
    bus->handle(kPeriod);
    for (const std::string& process : watch.endHanging(ProcessWatch::Clock::now())) {
      std::printf("%s has said nothing for %lld s: killed\n", process.c_str(),
                  static_cast<long long>(ProcessWatch::kHangs.count()));
    }
    for (const process_health_t& death : watch.takeDeaths()) {
      std::printf("%s %s\n", death.process.c_str(), death.message.c_str());
      bus->publish(channel, death);
      wake_until = ProcessWatch::Clock::now() + kWaking;
    }
    if (ProcessWatch::Clock::now() < wake_until) std::printf("waking supervisor\n");
    std::fflush(stdout);
  }
}

}  // namespace redbee
