// What is known of every process from its PROCESS_HEALTH, and the table that a person reads.
#pragma once

#include <chrono>
#include <map>
#include <string>
#include <vector>

#include "redbee/process_health_t.hpp"

namespace redbee {

/// How a line of the table is to look.
enum class Tone { kPlain, kHeading, kGood, kWarning, kBad };

struct BoardLine {
  std::string text;
  Tone tone = Tone::kPlain;
};

/// Times are the reader's own, so that a process that says nothing any more shows.
class HealthBoard {
 public:
  using Time = std::chrono::steady_clock::time_point;
  /// A process speaks once a second; more than this without a word is silence.
  static constexpr std::chrono::milliseconds kSilence{2500};

  void hear(const process_health_t& health, Time now);

  int processes() const { return static_cast<int>(entries_.size()); }
  /// Processes that are neither silent nor dead nor degraded.
  int good(Time now) const;

  /// Heading, one line a process (those of the stack also where they are not heard), then what a process has
  /// to say: at most `columns` (80 or more) wide.
  std::vector<BoardLine> table(Time now, int columns = 80) const;

 private:
  struct Entry {
    process_health_t last;
    Time heard;
    int restarts = 0;
    Time restarted;
  };

  static bool isSilent(const Entry& entry, Time now);
  static BoardLine row(const Entry& entry, Time now);
  void appendRemarks(std::vector<BoardLine>& lines, Time now) const;
  void appendBuilds(std::vector<BoardLine>& lines) const;

  std::map<std::string, Entry> entries_;
};

}  // namespace redbee
