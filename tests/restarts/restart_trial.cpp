// restart_trial: flies the endless flight into a running stack, kills its processes (-9) at random
// moments, in turn, and holds what the stack says against the truth. Exit 1 where something that was promised
// did not hold. Times are told and not judged: the machine may be busy with other things.
#include <signal.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <random>

#include "redbee/configuration/configuration.hpp"
#include "redbee/configuration/process_table.hpp"
#include "redbee/files/atomic_file.hpp"
#include "tests/restarts/live_player.hpp"
#include "tests/restarts/witness.hpp"

namespace redbee::test {
namespace {

using Clock = std::chrono::steady_clock;
constexpr double kSettling_s = 3;
constexpr double kLongestPause_s = 30;
constexpr int kSettledFrames = 30;
constexpr double kWildFraction = 1.0 / 25;  ///< no trusted mask may be more wrong than this

std::string vehicleYaml() {
  const simulation::Scenario scenario = loopedScenario();
  Configuration configuration;
  configuration.vehicle = "endless";
  configuration.camera = scenario.intrinsics;
  configuration.inertial.extrinsics = scenario.extrinsics;
  configuration.inertial.noise = scenario.imu.noise;
  return emitYaml(configuration);
}

std::vector<std::string> allPrograms() {
  std::vector<std::string> programs;
  for (const ProcessDescription* stage : kStages) programs.push_back(programName(*stage));
  return programs;
}

struct Kill {
  std::string process;
  int pid = 0;
  int64_t utime = 0;  ///< the newest frame that had been sent
  Clock::time_point when;
};

class Trial {
 public:
  Trial(const std::string& url, int kills, unsigned seed, double speed)
      : bus_(makeLcmBus(url)),
        witness_(*bus_, flight_),
        player_(*bus_, flight_, 20 + kills * 6.0, speed),
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
              [&] { return witness_.pids(kill.process).back() != kill.pid && settledSince(kill.utime); })) {
        return fail(kill.process + " is not back, or the stack does not recover");
      }
    }
    runFor(2);
    return judge();
  }

 private:
  bool fail(const std::string& what) {
    std::printf("FAILED: %s\n", what.c_str());
    return false;
  }

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
      return !witness_.pids(process).empty();
    });
    return all_here && witness_.allGood(utime + 1, kSettledFrames);
  }

  bool killNext() {
    if (turn_.empty()) {
      turn_ = programs_;
      std::shuffle(turn_.begin(), turn_.end(), random_);
    }
    const std::string process = turn_.back();
    turn_.pop_back();
    const int pid = witness_.pids(process).back();
    kills_.push_back({process, pid, player_.newestUtime(), Clock::now()});
    return ::kill(pid, SIGKILL) == 0 || fail(process + " was not running");
  }

  struct Figures {
    std::vector<double> resumed_s;  ///< of wall time, from the kill to the next trusted mask of a later frame
    std::vector<double> dark_s;     ///< of flight time, without a trusted mask
    int cars = 0;                   ///< seen before and after
    int kept = 0;                   ///< of them, with the same identity
    int reused = 0;                 ///< identities that another car had before
  };

  bool judge() {
    std::map<std::string, Figures> figures;
    for (const Kill& kill : kills_) {
      Figures& f = figures[kill.process];
      const auto next = witness_.firstGoodAfter(kill.utime);
      f.resumed_s.push_back(std::chrono::duration<double>(next->second.when - kill.when).count());
      f.dark_s.push_back(darkAfter(kill.utime));
      compareIdentities(kill.utime, f);
    }
    bool good = tell(figures);
    good = othersWentOn() && good;
    return masksWereNeverWild() && good;
  }

  /// Flight time in the second and a half after a kill that has no trusted mask.
  double darkAfter(int64_t utime) const {
    int dark = 0;
    for (int64_t k = flight_.frameAt(utime) + 1; k <= flight_.frameAt(utime) + 36; ++k) {
      const auto it = witness_.frames().find(flight_.utime(k));
      dark += it == witness_.frames().end() || it->second.status != 0 ? 1 : 0;
    }
    return static_cast<double>(dark) / kFps;
  }

  Identities identities(int64_t from_frame, int64_t to_frame) const {
    Identities all;
    for (int64_t k = from_frame; k <= to_frame; ++k) {
      const auto it = witness_.frames().find(flight_.utime(k));
      if (it == witness_.frames().end()) continue;
      for (const auto& [car, ids] : it->second.ids_of_car) all[car].insert(ids.begin(), ids.end());
    }
    return all;
  }

  static bool haveCommon(const std::set<int>& a, const std::set<int>& b) {
    return std::any_of(a.begin(), a.end(), [&](int id) { return b.count(id) > 0; });
  }

  /// Cars seen in the quarter of a second before and in the second after.
  void compareIdentities(int64_t utime, Figures& f) const {
    const int64_t k = flight_.frameAt(utime);
    const Identities before = identities(k - 5, k);
    for (const auto& [car, ids] : identities(k + 1, k + 24)) {
      const auto same = before.find(car);
      f.cars += same != before.end() ? 1 : 0;
      f.kept += same != before.end() && haveCommon(same->second, ids) ? 1 : 0;
      f.reused += std::any_of(before.begin(), before.end(),
                              [&, c = car, i = ids](const auto& b) {
                                return b.first != c && haveCommon(b.second, i);
                              })
                      ? 1
                      : 0;
    }
  }

  static double at(std::vector<double> values, double share) {
    std::sort(values.begin(), values.end());
    return values[static_cast<size_t>(share * static_cast<double>(values.size() - 1))];
  }

  bool tell(const std::map<std::string, Figures>& figures) {
    bool good = true;
    std::printf("%-28s %5s  %-22s %-22s %s\n", "killed", "times", "next trusted mask [s]", "without mask [s]",
                "identities kept, taken over");
    for (const auto& [process, f] : figures) {
      std::printf("%-28s %5zu  median %.2f worst %.2f  median %.2f worst %.2f  %d of %d, %d\n",
                  process.c_str(), f.resumed_s.size(), at(f.resumed_s, 0.5), at(f.resumed_s, 1),
                  at(f.dark_s, 0.5), at(f.dark_s, 1), f.kept, f.cars, f.reused);
      // A detector that loses one car in ten by itself is not what is tested here.
      if (process != programName(kMotionSegmentation) && f.kept < 0.8 * f.cars)
        good = fail("identities did not survive " + process);
    }
    Figures control;
    for (const Kill& kill : kills_) compareIdentities(kill.utime - 1700000, control);
    std::printf("undisturbed: identities kept %d of %d, taken over %d\n", control.kept, control.cars,
                control.reused);
    return good;
  }

  bool othersWentOn() {
    bool good = true;
    for (const std::string& process : programs_) {
      const auto killed =
          std::count_if(kills_.begin(), kills_.end(), [&](const Kill& k) { return k.process == process; });
      const auto lives = static_cast<std::ptrdiff_t>(witness_.pids(process).size());
      if (lives != killed + 1) good = fail(process + " lived " + std::to_string(lives) + " times");
    }
    std::printf("deaths told on PROCESS_HEALTH: %d of %zu\n", witness_.deathsTold(), kills_.size());
    return good;
  }

  /// Which kill a frame came after, and how long.
  std::string since(int64_t utime) const {
    const auto next =
        std::find_if(kills_.begin(), kills_.end(), [&](const Kill& kill) { return kill.utime >= utime; });
    if (next == kills_.begin()) return "before any kill, frame " + std::to_string(flight_.frameAt(utime));
    const Kill& last = *std::prev(next);
    return std::to_string(static_cast<double>(utime - last.utime) * 1e-6) + " s after " + last.process +
           ", frame " + std::to_string(flight_.frameAt(utime) % kLoopFrames) + " of the loop";
  }

  bool masksWereNeverWild() {
    int wild = 0;
    std::vector<double> shares;
    std::vector<double> found;
    for (const auto& [utime, told] : witness_.frames()) {
      if (told.status != 0) continue;
      shares.push_back(told.false_fraction);
      found.push_back(told.found_fraction);
      if (told.false_fraction <= kWildFraction) continue;
      ++wild;
      std::printf("wild: %.1f %% false, %s\n", 100 * told.false_fraction, since(utime).c_str());
    }
    std::printf("%zu trusted masks: false area median %.2f %%, worst %.2f %%; movers found, median %.0f %%\n",
                shares.size(), 100 * at(shares, 0.5), 100 * at(shares, 1), 100 * at(found, 0.5));
    return wild == 0 || fail(std::to_string(wild) + " masks are wild and were called good");
  }

  std::vector<std::string> programs_ = allPrograms();
  LoopedFlight flight_;
  std::unique_ptr<Bus> bus_;
  Witness witness_;
  LivePlayer player_;
  int kills_wanted_;
  double speed_;
  std::mt19937 random_;
  std::vector<std::string> turn_;
  std::vector<Kill> kills_;
};

}  // namespace
}  // namespace redbee::test

// A tool for us: an exception ends it with its message. NOLINTNEXTLINE(bugprone-exception-escape)
int main(int argc, char** argv) {
  CLI::App app("flies into a running stack and kills its processes");
  std::string url;
  std::string configuration;
  int kills = 8;
  unsigned seed = 1;
  double speed = 1;
  app.add_option("--lcm-url", url);
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
