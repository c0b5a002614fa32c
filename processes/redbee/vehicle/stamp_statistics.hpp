// The times inside the messages of one channel: rate, jitter, holes.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "redbee/geometry/median.hpp"

namespace redbee {

class StampStatistics {
 public:
  void note(int64_t utime, int64_t bytes) {
    times_us_.push_back(utime);
    bytes_ += bytes;
  }
  int64_t count() const { return static_cast<int64_t>(times_us_.size()); }
  int64_t bytes() const { return bytes_; }

  struct Summary {
    double rate_hz = 0;   ///< of the times; messages that came out of order are sorted
    double jitter_s = 0;  ///< standard deviation of a step from the steps' median, holes left out
    double longest_gap_s = 0;
    int64_t holes = 0;      ///< messages that the rhythm lacks
    int64_t backwards = 0;  ///< messages whose time was not after the one before
  };
  /// All zero of fewer than three messages.
  Summary summary() const {
    Summary summary;
    if (count() < 3) return summary;
    for (size_t i = 1; i < times_us_.size(); ++i) summary.backwards += times_us_[i] <= times_us_[i - 1];
    std::vector<int64_t> sorted = times_us_;
    std::sort(sorted.begin(), sorted.end());
    std::vector<double> steps_s;
    for (size_t i = 1; i < sorted.size(); ++i) {
      steps_s.push_back(1e-6 * static_cast<double>(sorted[i] - sorted[i - 1]));
    }
    const double period_s = median(steps_s);
    const double span_s = 1e-6 * static_cast<double>(sorted.back() - sorted.front());
    if (span_s > 0) summary.rate_hz = static_cast<double>(steps_s.size()) / span_s;
    double squares = 0;
    int64_t regular = 0;
    for (const double step_s : steps_s) {
      summary.longest_gap_s = std::max(summary.longest_gap_s, step_s);
      if (period_s > 0 && step_s > kHole * period_s) {
        summary.holes += std::lround(step_s / period_s) - 1;
        continue;
      }
      squares += (step_s - period_s) * (step_s - period_s);
      ++regular;
    }
    summary.jitter_s = regular > 0 ? std::sqrt(squares / static_cast<double>(regular)) : 0;
    return summary;
  }

 private:
  static constexpr double kHole = 1.5;  ///< periods: the nearest rhythm of a longer step lacks a message

  std::vector<int64_t> times_us_;
  int64_t bytes_ = 0;
};

}  // namespace redbee
