// The rhythm of a camera: the period of its frames, and whether a frame keeps it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <deque>
#include <optional>
#include <vector>

#include "redbee/geometry/time.hpp"

namespace redbee {

class FrameRhythm {
 public:
  /// Distance of two frames that followed each other.
  void note(Duration gap) {
    gaps_.push_back(gap);
    if (gaps_.size() > kGaps) gaps_.pop_front();
  }
  void clear() { gaps_.clear(); }

  /// Median distance of the latest frames; std::nullopt before the sixth.
  std::optional<Duration> period() const {
    if (gaps_.size() < kFewest) return std::nullopt;
    std::vector<Duration> sorted(gaps_.begin(), gaps_.end());
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    return *middle;
  }
  /// Whether two distances are as close as those of a regular camera of this period.
  static bool isSameBeat(Duration a, Duration b, Duration period) {
    return std::abs(static_cast<double>((a - b).count())) <= kRegular * static_cast<double>(period.count());
  }
  /// Whether a frame this far from another breaks a rhythm that the latest frames have kept closely: it is
  /// then of another source, or the rhythm has changed. Lost frames break none.
  bool isBrokenBy(Duration distance) const {
    const auto period = this->period();
    if (!period || gaps_.size() < kGaps) return false;
    const bool is_regular = std::all_of(gaps_.begin(), gaps_.end(),
                                        [&](Duration gap) { return deviation(gap, *period) <= kRegular; });
    const bool is_between_beats = 2 * std::abs(distance.count()) < period->count();
    return is_regular && (is_between_beats || deviation(distance, *period) > kBroken);
  }

 private:
  static constexpr size_t kFewest = 5;
  static constexpr size_t kGaps = 15;
  static constexpr double kRegular = 0.02;  ///< periods; drivers that stamp exposures deviate by less
  static constexpr double kBroken = 0.1;    ///< periods

  /// From a multiple of the period [periods].
  static double deviation(Duration gap, Duration period) {
    const double beats = static_cast<double>(gap.count()) / static_cast<double>(period.count());
    return std::abs(beats - std::round(beats));
  }

  std::deque<Duration> gaps_;
};

}  // namespace redbee
