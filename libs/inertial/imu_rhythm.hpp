// Tells a second IMU's samples by the rhythm of the first.
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>

#include "redbee/geometry/gap_window.hpp"
#include "redbee/geometry/time.hpp"

namespace redbee {

/// Samples carry no sender, but an IMU that is driven by its own oscillator keeps its period closely, and the
/// samples of another one lie between its beats. Where the times are less regular than kRegular, or two IMUs
/// have been mixed from the beginning, nothing can be told and all samples are taken.
class ImuRhythm {
 public:
  /// Whether a sample is of the IMU that is listened to. Lost, late and repeated samples keep the rhythm.
  bool isKeptBy(ImuTime time) {
    const std::optional<Duration> period = regularPeriod();
    if (period && beatsBetween(*last_, time, *period) < kMaxSilence_beats) {
      if (isBetweenBeats(time - *last_, *period)) {
        was_passed_ = true;
        return false;
      }
      // The first IMU misses beats where another speaks: it is the same one, at another rate.
      const bool missed = was_passed_ && time - *last_ > *period + *period / 2;
      missed_in_a_row_ = missed ? missed_in_a_row_ + 1 : 0;
      was_passed_ = false;
      if (missed_in_a_row_ < kMissedInARow) {
        const bool is_beat = time > *last_ && deviationOf(time - *last_, *period) <= kRegular;
        if (is_beat) note(time);
        return true;
      }
    }
    if (last_ && (period || time < *last_)) restart();
    note(time);
    return true;
  }

 private:
  static constexpr std::size_t kGaps = 31;
  static constexpr double kRegular = 0.05;  ///< periods
  static constexpr double kBroken = 0.1;    ///< periods
  static constexpr double kMaxSilence_beats = 10;
  static constexpr int kMissedInARow = 5;

  void restart() {
    gaps_.clear();
    last_.reset();
    was_passed_ = false;
    missed_in_a_row_ = 0;
  }
  void note(ImuTime time) {
    if (last_ && time > *last_) gaps_.note(time - *last_);
    last_ = time;
  }
  /// Median of the latest gaps, if all are close to a multiple of it.
  std::optional<Duration> regularPeriod() const {
    if (!gaps_.isFull()) return std::nullopt;
    const Duration period = gaps_.median();
    const bool is_regular = gaps_.allOf([&](Duration gap) {
      return std::round(beatsOf(gap, period)) >= 1 && deviationOf(gap, period) <= kRegular;
    });
    return is_regular ? std::optional<Duration>(period) : std::nullopt;
  }
  /// A second sample on one beat is between, too.
  static bool isBetweenBeats(Duration gap, Duration period) {
    return deviationOf(gap, period) > kBroken || (gap > Duration(0) && beatsOf(gap, period) < 0.5);
  }
  /// As doubles, so that differences cannot overflow.
  static double beatsBetween(ImuTime a, ImuTime b, Duration period) {
    return std::abs(static_cast<double>(toUtime(b)) - static_cast<double>(toUtime(a))) /
           static_cast<double>(period.count());
  }

  GapWindow gaps_{kGaps};
  std::optional<ImuTime> last_;
  bool was_passed_ = false;  ///< a sample between the beats has come since the last one
  int missed_in_a_row_ = 0;
};

}  // namespace redbee
