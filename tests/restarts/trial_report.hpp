// Results of the restart trial: figures by killed process, and whether the requirements were met.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/live_trial.hpp"

namespace redbee::test {

struct Kill {
  std::string process;
  bool hang = false;  ///< SIGSTOP; the watch has to end it
  int pid = 0;
  int64_t utime = 0;  ///< newest frame sent before
  std::chrono::steady_clock::time_point when;
};

class TrialReport {
 public:
  TrialReport(const EndlessFlight& flight, const Observer& observer, const std::vector<Kill>& kills)
      : flight_(flight), observer_(observer), kills_(kills) {}

  /// Prints the figures. Returns false if a requirement was not met.
  bool print() {
    std::map<std::string, Figures> figures;
    for (const Kill& kill : kills_) {
      Figures& f = figures[kill.process + (kill.hang ? ", hung" : "")];
      const auto next = observer_.firstGoodAfter(kill.utime);
      f.resumed_s.push_back(std::chrono::duration<double>(next->second.received - kill.when).count());
      f.hang = kill.hang;
      f.without_s.push_back(withoutMaskAfter(kill));
      compareIdentities(kill.utime, f);
    }
    bool good = printFigures(figures);
    good = othersKeptRunning() && good;
    return falseAreaIsBounded() && good;
  }

 private:
  struct Figures {
    std::vector<double>
        resumed_s;  ///< wall time from the kill to the next mask with status GOOD of a later frame
    std::vector<double> without_s;  ///< flight time without a mask with status GOOD
    bool hang = false;
    int cars = 0;    ///< seen before and after
    int kept = 0;    ///< of these, with the same identity
    int reused = 0;  ///< identities that another car had before
  };

  /// Flight time without a GOOD mask in the 1.5 s after a kill, the 4 s after a hang.
  double withoutMaskAfter(const Kill& kill) const {
    int frames = 0;
    const int64_t first = flight_.frameAt(kill.utime) + 1;
    for (int64_t k = first; k < first + (kill.hang ? 4 : 1.5) * kFps; ++k) {
      const auto it = observer_.frames().find(flight_.utime(k));
      frames += it == observer_.frames().end() || it->second.status != 0 ? 1 : 0;
    }
    return static_cast<double>(frames) / kFps;
  }

  Identities identities(int64_t from_frame, int64_t to_frame) const {
    Identities all;
    for (int64_t k = from_frame; k <= to_frame; ++k) {
      const auto it = observer_.frames().find(flight_.utime(k));
      if (it == observer_.frames().end()) continue;
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

  static double at(std::vector<double> values, double fraction) {
    std::sort(values.begin(), values.end());
    return values[static_cast<size_t>(fraction * static_cast<double>(values.size() - 1))];
  }

  bool printFigures(const std::map<std::string, Figures>& figures) {
    bool good = true;
    std::printf("%-34s %5s  %-22s %-22s %s\n", "killed", "times", "next GOOD mask [s]", "without mask [s]",
                "identities kept, taken over");
    for (const auto& [process, f] : figures) {
      std::printf("%-34s %5zu  median %.2f worst %.2f  median %.2f worst %.2f  %d of %d, %d\n",
                  process.c_str(), f.resumed_s.size(), at(f.resumed_s, 0.5), at(f.resumed_s, 1),
                  at(f.without_s, 0.5), at(f.without_s, 1), f.kept, f.cars, f.reused);
      // The detector loses some cars without restarts, too.
      if (process.rfind(programName(kMotionSegmentation), 0) != 0 && !f.hang && f.kept < 0.8 * f.cars)
        good = fail("identities did not survive " + process);
    }
    Figures control;
    for (const Kill& kill : kills_) compareIdentities(kill.utime - 1700000, control);
    std::printf("undisturbed: identities kept %d of %d, taken over %d\n", control.kept, control.cars,
                control.reused);
    return good;
  }

  bool othersKeptRunning() {
    bool good = true;
    for (const std::string& process : allPrograms()) {
      const auto killed =
          std::count_if(kills_.begin(), kills_.end(), [&](const Kill& k) { return k.process == process; });
      good = hasLived(observer_, process, static_cast<size_t>(killed) + 1) && good;
    }
    std::printf("deaths reported on PROCESS_HEALTH: %d of %zu\n", observer_.deathsReported(), kills_.size());
    return good;
  }

  /// The last kill before a frame, and the time since then.
  std::string since(int64_t utime) const {
    const auto next =
        std::find_if(kills_.begin(), kills_.end(), [&](const Kill& kill) { return kill.utime >= utime; });
    if (next == kills_.begin()) return "before any kill, frame " + std::to_string(flight_.frameAt(utime));
    const Kill& last = *std::prev(next);
    return std::to_string(seconds(fromUtime(utime - last.utime))) + " s after " + last.process + ", frame " +
           std::to_string(flight_.frameAt(utime) % kLoopFrames) + " of the loop";
  }

  bool falseAreaIsBounded() {
    int excessive = 0;
    std::vector<double> false_fractions;
    std::vector<double> found;
    for (const auto& [utime, frame] : observer_.frames()) {
      if (frame.status != 0) continue;
      false_fractions.push_back(frame.false_fraction);
      found.push_back(frame.found_fraction);
      if (frame.false_fraction <= kMaxFalseFraction) continue;
      ++excessive;
      std::printf("false area: %.1f %% false, %s\n", 100 * frame.false_fraction, since(utime).c_str());
    }
    std::printf("%zu GOOD masks: false area median %.2f %%, worst %.2f %%; movers found, median %.0f %%\n",
                false_fractions.size(), 100 * at(false_fractions, 0.5), 100 * at(false_fractions, 1),
                100 * at(found, 0.5));
    return excessive == 0 ||
           fail(std::to_string(excessive) + " masks with status GOOD have too much false area");
  }

  static constexpr double kMaxFalseFraction = 1.0 / 25;  ///< limit of the false fraction of GOOD masks

  const EndlessFlight& flight_;
  const Observer& observer_;
  const std::vector<Kill>& kills_;
};

}  // namespace redbee::test
