#include <unistd.h>

#include <cstdio>
#include <cstdlib>

#include "processes/redbee/vehicle/heartbeat_receiver.hpp"
#include "processes/redbee/vehicle/mutual_watch.hpp"
#include "processes/redbee/vehicle/watch.hpp"
#include "redbee/bus/bus.hpp"
#include "redbee/configuration/configuration.hpp"
#include "redbee/configuration/process_table.hpp"
#include "redbee/node/heartbeat.hpp"
#include "redbee/node/node.hpp"

namespace redbee {
namespace {

using Clock = ProcessWatch::Clock;
constexpr std::chrono::milliseconds kWatchPeriod{20};
constexpr std::chrono::milliseconds kShortestPause{100};  ///< between two questions to supervisor
constexpr std::chrono::seconds kLongestPause{1};
constexpr std::chrono::milliseconds kWaking{500};
constexpr std::chrono::minutes kReportPeriod{1};
constexpr std::chrono::seconds kFarewell{5};            ///< a busy systemd may take; supervisor waits ten
constexpr std::chrono::seconds kSupervisorTimeout{20};  ///< without its answer systemd starts it again

/// All of the table but the watch itself, whose two halves watch each other.
std::map<std::string, std::filesystem::path> watchedPrograms() {
  const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  std::map<std::string, std::filesystem::path> programs;
  for (const auto* stage : kStages) programs[std::string(stage->name)] = folder / programName(*stage);
  for (const auto* driver : kDrivers) programs[std::string(driver->name)] = folder / programName(*driver);
  for (const auto* process : kSupportProcesses) {
    if (process != &kWatch) programs[std::string(process->name)] = folder / "redbee";
  }
  return programs;
}

/// The child of the pair.
class Worker {
 public:
  Worker(const Configuration& configuration, const std::string& url, pid_t supervisor,
         SupervisorClient client)
      : channel_(configuration.channels.health),
        client_(std::move(client)),
        heartbeats_(heartbeatSocket()),
        watch_({supervisor, watchedPrograms(),
                std::chrono::duration<double>(configuration.watch.hang_timeout_s)},
               [this] { return askSupervisor(); }),
        bus_(makeLcmBus(url)),
        subscription_(bus_->subscribe<process_health_t>(
            channel_, kListenerQueue, [this](const process_health_t& health) { watch_.onHealth(health); },
            nullptr)) {}

  void run(Partner& guard) {
    const std::atomic<bool>& stop = stopOnSignals();
    systemd_.send("WATCHDOG_USEC=" + std::to_string(std::chrono::microseconds(kSupervisorTimeout).count()));
    while (!stop) {
      bus_->handle(kWatchPeriod);
      step();
      switch (guard.exchange(Clock::now())) {
        case Partner::State::kAlive:
          continue;
        case Partner::State::kHung:
          std::printf("the watch's guard hangs: killed\n");
          guard.end();
          [[fallthrough]];
        case Partner::State::kGone:
          wakeSupervisor();
          return;
      }
    }
    // Who stops the watch does not mean to stop the flight. systemd must have taken it before this process
    // ends.
    systemd_.deliver("WATCHDOG_USEC=0", kFarewell, [&] { guard.exchange(Clock::now()); });
  }

 private:
  static std::filesystem::path heartbeatSocket() {
    const char* path = std::getenv("NOTIFY_SOCKET");  // NOLINT(concurrency-mt-unsafe)
    if (path == nullptr)
      throw UserError("redbee watch: NOTIFY_SOCKET is not set; start the stack with: fly up");
    return path;
  }

  /// While supervisor answers, systemd (if it started the stack) is told that all is well: nobody else would
  /// end a supervisor that hangs.
  std::optional<std::vector<SupervisedProcess>> askSupervisor() {
    auto processes = client_.processes();
    if (processes) systemd_.beat();
    return processes;
  }

  void step() {
    const auto now = Clock::now();
    for (const pid_t sender : heartbeats_.drain()) {
      if (!watch_.onHeartbeat(sender, now))
        is_stranger_alive_ = true;  // perhaps of a process that was just started
    }
    const auto pause = is_stranger_alive_ || now < wake_until_ ? kShortestPause : kLongestPause;
    if (now >= asked_ + pause) {
      is_stranger_alive_ = false;
      watch_.refresh(now);
      asked_ = now;
    }
    for (const std::string& process : watch_.killHanging(Clock::now()))
      std::printf("%s gives no sign of life: killed\n", process.c_str());
    for (const process_health_t& death : watch_.drainDeaths()) {
      std::printf("%s %s\n", death.process.c_str(), death.message.c_str());
      bus_->publish(channel_, death);
      wake_until_ = now + kWaking;
    }
    reportStrangers(now);
    std::fflush(stdout);
  }

  void reportStrangers(Clock::time_point now) {
    if (watch_.strangers() == strangers_reported_ || now < next_report_) return;
    std::printf("%lld health messages that are implausible or of processes that are not supervisor's\n",
                static_cast<long long>(watch_.strangers() - strangers_reported_));
    strangers_reported_ = watch_.strangers();
    next_report_ = now + kReportPeriod;
  }

  void wakeSupervisor() {
    for (const auto end = Clock::now() + kWaking; Clock::now() < end; usleep(50'000)) client_.processes();
  }

  std::string channel_;
  SupervisorClient client_;
  Heartbeat systemd_{"REDBEE_SYSTEMD_SOCKET"};
  HeartbeatReceiver heartbeats_;
  ProcessWatch watch_;
  std::unique_ptr<Bus> bus_;
  Subscription subscription_;
  Clock::time_point asked_;
  Clock::time_point wake_until_;
  Clock::time_point next_report_;
  bool is_stranger_alive_ = false;
  int64_t strangers_reported_ = 0;
};

}  // namespace

int runWatch(const WatchOptions& options) {
  const Configuration configuration = loadConfiguration(options.configuration);
  const SupervisorClient client = SupervisorClient::ofParent();
  const pid_t supervisor = getppid();
  return watchEachOther(
      std::chrono::duration<double>(configuration.watch.hang_timeout_s),
      [&](Partner& guard) { Worker(configuration, options.url, supervisor, client).run(guard); });
}

}  // namespace redbee
