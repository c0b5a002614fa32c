// restart_trial: publishes the endless flight to a running stack, kills its processes (SIGKILL) or makes them
// hang (SIGSTOP, every third time) at random times, in turn, and compares the output with the truth. Exit
// status 1 if a requirement is not met. Times are printed but not checked, as the machine may be busy.
#include <signal.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <random>

#include "processes/common_options.hpp"
#include "redbee/configuration/configuration.hpp"
#include "redbee/files/atomic_file.hpp"
#include "tests/restarts/trial_report.hpp"
#include "tests/support/live_player.hpp"

namespace redbee::test {
namespace {

using Clock = std::chrono::steady_clock;
constexpr double kSettling_s = 3;
constexpr double kLongestPause_s = 30;
constexpr int kSettledFrames = 30;
constexpr size_t kHangEvery = 3;

std::string vehicleYaml() {
  const simulation::Scenario scenario = endlessScenario();
  Configuration configuration;
  configuration.vehicle = "endless";
  configuration.camera = scenario.intrinsics;
  configuration.inertial.extrinsics = scenario.extrinsics;
  configuration.inertial.noise = scenario.imu.noise;
  return emitYaml(configuration);
}

class Trial {
 public:
  Trial(const std::string& url, int kills, unsigned seed, double speed)
      : bus_(makeLcmBus(url)),
        observer_(*bus_, flight_),
        player_(*bus_, flight_, 20 + kills * 8.0, speed),
        kills_wanted_(kills),
        speed_(speed),
        random_(seed) {}

  bool fly() {
    runFor(kSettling_s);
    if (!runUntil([&] { return settledSince(0); })) return fail("the stack does not fly undisturbed");
    while (static_cast<int>(kills_.size()) < kills_wanted_) {
      runFor(std::uniform_real_distribution<double>(0.2, 1.0)(random_));
      if (!killNext()) return false;
      const Kill& kill = kills_.back();
      if (!runUntil(
              [&] { return observer_.pids(kill.process).back() != kill.pid && settledSince(kill.utime); })) {
        return fail(kill.process + " is not back, or the stack does not recover");
      }
    }
    runFor(2);
    return TrialReport(flight_, observer_, kills_).print();
  }

 private:
  void step() {
    player_.publishDue();
    bus_->handle(std::chrono::milliseconds(2));
  }
  /// Of flight time.
  void runFor(double seconds) {
    const auto end = Clock::now() + std::chrono::duration<double>(seconds / speed_);
    while (Clock::now() < end) step();
  }
  template <typename Done>
  bool runUntil(const Done& done) {
    const auto end = Clock::now() + std::chrono::duration<double>(kLongestPause_s / speed_);
    while (!done() && Clock::now() < end && !player_.isOver()) step();
    return done();
  }
  bool settledSince(int64_t utime) const {
    const bool all_here = std::all_of(programs_.begin(), programs_.end(), [&](const std::string& process) {
      return !observer_.pids(process).empty();
    });
    return all_here && observer_.allGood(utime + 1, kSettledFrames);
  }

  bool killNext() {
    if (turn_.empty()) {
      turn_ = programs_;
      std::shuffle(turn_.begin(), turn_.end(), random_);
    }
    const std::string process = turn_.back();
    turn_.pop_back();
    const int pid = observer_.pids(process).back();
    const bool hang = kills_.size() % kHangEvery == kHangEvery - 1;
    kills_.push_back({process, hang, pid, player_.newestUtime(), Clock::now()});
    return ::kill(pid, hang ? SIGSTOP : SIGKILL) == 0 || fail(process + " was not running");
  }

  std::vector<std::string> programs_ = allPrograms();
  EndlessFlight flight_;
  std::unique_ptr<Bus> bus_;
  Observer observer_;
  LivePlayer player_;
  int kills_wanted_;
  double speed_;
  std::mt19937 random_;
  std::vector<std::string> turn_;
  std::vector<Kill> kills_;
};

}  // namespace
}  // namespace redbee::test

// For tests: an exception ends it with its message. NOLINTNEXTLINE(bugprone-exception-escape)
int main(int argc, char** argv) {
  CLI::App app("flies into a running stack and kills its processes");
  std::string url;
  std::string configuration;
  int kills = 8;
  unsigned seed = 1;
  double speed = 1;
  redbee::addLcmUrlOption(app, url);
  app.add_option("--kills", kills);
  app.add_option("--seed", seed);
  app.add_option("--speed", speed, "times the flight's own speed");
  app.add_option("--write-configuration", configuration, "write the vehicle's YAML file and end");
  CLI11_PARSE(app, argc, argv);
  if (!configuration.empty()) {
    redbee::writeAtomically(configuration, redbee::test::vehicleYaml());
    return 0;
  }
  return redbee::test::Trial(url, kills, seed, speed).fly() ? 0 : 1;
}
