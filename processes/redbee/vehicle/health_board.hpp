// The latest PROCESS_HEALTH of every process as a table.
#pragma once

#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "redbee/process_health_t.hpp"

namespace redbee {

/// Style of a line of the table.
enum class Tone { kPlain, kHeading, kGood, kWarning, kBad };

struct BoardLine {
  std::string text;
  Tone tone = Tone::kPlain;
};

/// Times are times of receipt, so that processes that stop publishing are noticed.
class HealthBoard {
 public:
  using Time = std::chrono::steady_clock::time_point;
  /// A process publishes its health once a second; after this long without a message it counts as silent.
  static constexpr std::chrono::milliseconds kSilence{2500};

  /// Messages of names outside the process table and implausible ones (health_check.hpp) are counted, not
  /// kept.
  void onHealth(const process_health_t& health, Time now);

  /// A process as the table shows it.
  struct Process {
    std::string name;   ///< without "redbee-"
    std::string state;  ///< "good", ..., "silent", "no messages"
    Tone tone = Tone::kBad;
    std::optional<process_health_t> last;
    double silent_s = 0;  ///< s since its last message
    int restarts = 0;     ///< seen
  };
  /// In the order of the table.
  std::vector<Process> list(Time now) const;

  int processes() const { return static_cast<int>(entries_.size()); }
  /// Processes that are neither silent nor dead nor degraded.
  int good(Time now) const;

  /// Heading, one line per process (stages of the process table also before their first message), then
  /// remarks; at most `columns` (80 or more) wide, remarks in as many lines as they take.
  std::vector<BoardLine> table(Time now, int columns = 80) const;

 private:
  struct Entry {
    process_health_t last;
    Time received;
    int restarts = 0;
    Time restarted;
  };

  static bool isSilent(const Entry& entry, Time now);
  static BoardLine row(const Process& process);
  void appendRemarks(std::vector<BoardLine>& lines, Time now) const;
  void appendBuilds(std::vector<BoardLine>& lines) const;

  std::map<std::string, Entry> entries_;  ///< only names of the process table
  int64_t strangers_ = 0;
  int64_t implausible_ = 0;
};

}  // namespace redbee
