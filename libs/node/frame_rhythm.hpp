// The rhythm of a camera: the period of its frames, and whether a frame keeps it.
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>

#include "redbee/geometry/gap_window.hpp"
#include "redbee/geometry/time.hpp"

namespace redbee {

class FrameRhythm {
 public:
  /// Distance of two frames that followed each other.
  void note(Duration gap) { gaps_.note(gap); }
  void clear() { gaps_.clear(); }

  /// Median distance of the latest frames; std::nullopt before the sixth.
  std::optional<Duration> period() const {
    if (gaps_.size() < kFewest) return std::nullopt;
    return gaps_.median();
  }
  /// Whether two distances are as close as those of a regular camera of this period.
  static bool isSameBeat(Duration a, Duration b, Duration period) {
    return std::abs(static_cast<double>((a - b).count())) <= kRegular * static_cast<double>(period.count());
  }
  /// Whether a frame this far from another breaks a rhythm that the latest frames have kept closely: it is
  /// then of another source, or the rhythm has changed. Lost frames break none.
  bool isBrokenBy(Duration distance) const {
    const auto period = this->period();
    if (!period || !gaps_.isFull()) return false;
    const bool is_regular = gaps_.allOf([&](Duration gap) { return deviationOf(gap, *period) <= kRegular; });
    const bool is_between_beats = 2 * std::abs(distance.count()) < period->count();
    return is_regular && (is_between_beats || deviationOf(distance, *period) > kBroken);
  }

 private:
  static constexpr size_t kFewest = 5;
  static constexpr size_t kGaps = 15;
  static constexpr double kRegular = 0.02;  ///< periods; drivers that stamp exposures deviate by less
  static constexpr double kBroken = 0.1;    ///< periods

  GapWindow gaps_{kGaps};
};

}  // namespace redbee
