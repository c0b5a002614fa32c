// The latest gaps between the messages of a source, by which its rhythm is told.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <deque>
#include <numeric>
#include <vector>

#include "redbee/geometry/median.hpp"
#include "redbee/geometry/time.hpp"

namespace redbee {

/// Length of a gap [periods].
inline double beatsOf(Duration gap, Duration period) {
  return static_cast<double>(gap.count()) / static_cast<double>(period.count());
}
/// By how much a gap deviates from a multiple of the period [periods]: 0 to 0.5.
inline double deviationOf(Duration gap, Duration period) {
  const double beats = beatsOf(gap, period);
  return std::abs(beats - std::round(beats));
}

class GapWindow {
 public:
  explicit GapWindow(std::size_t most) : most_(most) {}

  void note(Duration gap) {
    gaps_.push_back(gap);
    if (gaps_.size() > most_) gaps_.pop_front();
  }
  void clear() { gaps_.clear(); }
  std::size_t size() const { return gaps_.size(); }
  bool isFull() const { return gaps_.size() == most_; }
  /// Precondition: there is one.
  Duration median() const { return redbee::median(std::vector<Duration>(gaps_.begin(), gaps_.end())); }
  Duration total() const { return std::accumulate(gaps_.begin(), gaps_.end(), Duration(0)); }
  /// Whether `holds` of each gap.
  template <typename Predicate>
  bool allOf(const Predicate& holds) const {
    return std::all_of(gaps_.begin(), gaps_.end(), holds);
  }

 private:
  std::size_t most_;
  std::deque<Duration> gaps_;
};

}  // namespace redbee
