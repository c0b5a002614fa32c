// Tells a second IMU's samples by the rhythm of the first.
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "redbee/geometry/gap_window.hpp"
#include "redbee/geometry/time.hpp"
#include "redbee/inertial/mixed_sources.hpp"

namespace redbee {

/// Samples carry no sender, but an IMU that is driven by its own oscillator keeps its period closely, and the
/// samples of another one lie between its beats; of two that are mixed from the beginning the first is
/// listened to as soon as its beats are told apart (MixedSources). Where the times are less regular than
/// kRegular, nothing can be told and all samples are taken.
class ImuRhythm {
 public:
  /// Whether a sample is of the IMU that is listened to. Lost, late and repeated samples keep the rhythm.
  bool isKeptBy(ImuTime time) {
    const std::optional<Duration> period = regularPeriod();
    if (period && hasMostBeats(*period)) {
      window_.clear();
    } else if (const std::optional<SampleTrain> train = findTrain(time)) {
      return follow(*train, time);
    }
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

  /// Whether two sources were told apart since the last call: samples before were of both.
  bool takeWereMixed() { return std::exchange(were_mixed_, false); }

 private:
  static constexpr std::size_t kGaps = 31;
  static constexpr double kRegular = 0.05;  ///< periods
  static constexpr double kBroken = 0.1;    ///< periods
  static constexpr double kMaxSilence_beats = 10;
  static constexpr int kMissedInARow = 5;
  static constexpr double kMostBeats = 1.2;  ///< periods a gap, on average

  void restart() {
    window_.clear();
    gaps_.clear();
    last_.reset();
    was_passed_ = false;
    missed_in_a_row_ = 0;
  }
  void note(ImuTime time) {
    if (last_ && time > *last_) gaps_.note(time - *last_);
    last_ = time;
  }
  /// Looks for two sources where there is no rhythm, or one that misses beats: the samples of two whose phase
  /// is a simple fraction of the period lie on a common, finer one.
  std::optional<SampleTrain> findTrain(ImuTime time) {
    window_.push_back(time);
    if (window_.size() < MixedSources::kWindow) return std::nullopt;
    return MixedSources::find(std::exchange(window_, {}));
  }
  /// Whether `time` is of the train.
  bool follow(const SampleTrain& train, ImuTime time) {
    were_mixed_ = true;
    restart();
    while (!gaps_.isFull()) gaps_.note(train.period);
    last_ = train.last;
    return time == train.last;
  }
  bool hasMostBeats(Duration period) const {
    return beatsOf(gaps_.total(), period) < kMostBeats * static_cast<double>(gaps_.size());
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
  std::vector<ImuTime> window_;  ///< times while there is no rhythm
  std::optional<ImuTime> last_;
  bool was_passed_ = false;  ///< a sample between the beats has come since the last one
  int missed_in_a_row_ = 0;
  bool were_mixed_ = false;
};

}  // namespace redbee
