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

namespace redbee::test {
namespace {

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

class Trial : LiveTrial {
 public:
  Trial(const std::string& url, int kills, unsigned seed, double speed)
      : LiveTrial(url, 17 + kills * 8.0, speed), kills_wanted_(kills), random_(seed) {}

  bool fly() {
    if (!settle()) return false;
    while (static_cast<int>(kills_.size()) < kills_wanted_) {
      runFor(std::uniform_real_distribution<double>(0.2, 1.0)(random_));
      if (!killNext()) return false;
      const Kill& kill = kills_.back();
      if (!runUntil(
              [&] { return observer().pids(kill.process).back() != kill.pid && settledSince(kill.utime); })) {
        return fail(kill.process + " is not back, or the stack does not recover");
      }
    }
    runFor(2);
    return TrialReport(flight(), observer(), kills_).print();
  }

 private:
  bool killNext() {
    if (turn_.empty()) {
      turn_ = programs();
      std::shuffle(turn_.begin(), turn_.end(), random_);
    }
    const std::string process = turn_.back();
    turn_.pop_back();
    const int pid = observer().pids(process).back();
    const bool hang = kills_.size() % kHangEvery == kHangEvery - 1;
    kills_.push_back({process, hang, pid, player().newestUtime(), Clock::now()});
    return ::kill(pid, hang ? SIGSTOP : SIGKILL) == 0 || fail(process + " was not running");
  }

  int kills_wanted_;
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
