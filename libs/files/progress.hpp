// Progress messages for work that takes longer than a second.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace redbee {

/// Prints progress on stderr once the work has taken a second: on a terminal one line that is redrawn,
/// elsewhere a line every few seconds.
class Progress {
 public:
  /// `what`: "importing karma.mp4". `unit`: "frames". `quiet`: prints nothing.
  Progress(std::string what, std::string unit, bool quiet = false);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `total` 0: unknown.
  void update(int64_t done, int64_t total);
  /// Ends the line. Also called by the destructor.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;

  std::string line() const;

  std::string what_;
  std::string unit_;
  bool quiet_;
  bool terminal_;
  bool shown_ = false;
  int64_t done_ = 0;
  int64_t total_ = 0;
  Clock::time_point start_;
  Clock::time_point next_;
};

}  // namespace redbee
