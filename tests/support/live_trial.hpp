// Flies the endless flight into a running stack and observes what it says.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "redbee/configuration/process_table.hpp"
#include "tests/support/live_player.hpp"
#include "tests/support/observer.hpp"

namespace redbee::test {

inline std::vector<std::string> allPrograms() {
  std::vector<std::string> programs;
  programs.reserve(kStages.size());
  for (const ProcessDescription* stage : kStages) programs.push_back(programName(*stage));
  return programs;
}

inline bool fail(const std::string& what) {
  std::printf("FAILED: %s\n", what.c_str());
  return false;
}

/// Whether a program was started so often.
inline bool hasLived(const Observer& observer, const std::string& process, size_t times) {
  const size_t lives = observer.pids(process).size();
  return lives == times || fail(process + " lived " + std::to_string(lives) + " times");
}

/// Base of the trials. Times are those of the flight, which is flown `speed` times as fast.
class LiveTrial {
 protected:
  using Clock = std::chrono::steady_clock;

  /// `longest_s`: of the flight, beside the time to settle.
  LiveTrial(const std::string& url, double longest_s, double speed)
      : bus_(makeLcmBus(url)),
        observer_(*bus_, flight_),
        player_(*bus_, flight_, kSettling_s + longest_s, speed),
        speed_(speed) {}

  /// Until all processes run and their masks are trusted.
  bool settle() {
    runFor(kSettling_s);
    return runUntil([&] { return settledSince(0); }) || fail("the stack does not fly undisturbed");
  }
  void runFor(double seconds) {
    const auto end = Clock::now() + std::chrono::duration<double>(seconds / speed_);
    while (Clock::now() < end) step();
  }
  /// Returns whether it is done, after kLongestPause_s at the latest.
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

  const std::vector<std::string>& programs() const { return programs_; }
  const EndlessFlight& flight() const { return flight_; }
  const Observer& observer() const { return observer_; }
  const LivePlayer& player() const { return player_; }

  static constexpr double kSettling_s = 3;
  static constexpr double kLongestPause_s = 30;

 private:
  static constexpr int kSettledFrames = 30;

  void step() {
    player_.publishDue();
    bus_->handle(std::chrono::milliseconds(2));
  }

  std::vector<std::string> programs_ = allPrograms();
  EndlessFlight flight_;
  std::unique_ptr<Bus> bus_;
  Observer observer_;
  LivePlayer player_;
  double speed_;
};

}  // namespace redbee::test
