// Progress on anything longer than a second.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace redbee {

/// Prints progress on stderr once the work has taken a second: one line redrawn on a terminal, a line every
/// few seconds elsewhere. Shorter work prints nothing.
class Progress {
 public:
  /// `what`: "importing karma.mp4". `unit`: "frames". `quiet` prints nothing at all.
  Progress(std::string what, std::string unit, bool quiet = false);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `total` 0: not known.
  void update(int64_t done, int64_t total);
  /// Ends the line. Called by the destructor too.
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
