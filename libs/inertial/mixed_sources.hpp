// Finds one IMU's samples among those of two by their times alone.
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "redbee/geometry/time.hpp"

namespace redbee {

/// Beats of one source.
struct SampleTrain {
  Duration period;
  ImuTime last;
};

/// Searches a window of times for the train of beats that begins first, misses none, and has other samples
/// between its beats that do not divide them evenly: samples that do are the same source's, whose times are
/// less regular. std::nullopt if there is none, or no other sample.
class MixedSources {
 public:
  static constexpr std::size_t kWindow = 64;

  /// `times`: in order of arrival.
  static std::optional<SampleTrain> find(const std::vector<ImuTime>& times) {
    for (std::size_t i = 1; i < times.size(); ++i) {
      if (times[i] < times[i - 1]) return std::nullopt;
    }
    for (std::size_t first = 0; first < kMostBetween; ++first) {
      for (std::size_t next = first + 1; next <= first + kMostBetween + 1; ++next) {
        if (next >= times.size() || times[next] == times[first]) continue;
        if (const auto train = trainFrom(times, first, next)) return train;
      }
    }
    return std::nullopt;
  }

 private:
  static constexpr std::size_t kMostBetween = 2;  ///< samples of the other source between two beats
  static constexpr double kRegular = 0.05;        ///< periods
  static constexpr int kLeastOthers = 8;
  static constexpr double kUneven = 0.125;  ///< periods, from an even division

  static std::optional<SampleTrain> trainFrom(const std::vector<ImuTime>& times, std::size_t first,
                                              std::size_t next) {
    const Duration period = times[next] - times[first];
    const auto beatsSince = [&](ImuTime beat, ImuTime time) {
      return static_cast<double>((time - beat).count()) / static_cast<double>(period.count());
    };
    ImuTime last = times[first];
    std::vector<double> between;  // since the last beat, of one interval
    int beats_kept = 0;
    int others = 0;
    double uneven = 0;
    for (std::size_t i = first + 1; i < times.size(); ++i) {
      const double beats = beatsSince(last, times[i]);
      if (beats > 1 + kRegular) return std::nullopt;  // a beat is missing
      if (beats < 1 - kRegular) {
        between.push_back(beats);
        continue;
      }
      for (std::size_t j = 0; j < between.size(); ++j) {
        const double even = static_cast<double>(j + 1) / static_cast<double>(between.size() + 1);
        uneven += std::abs(between[j] - even);
        ++others;
      }
      between.clear();
      last = times[i];
      ++beats_kept;
    }
    if (others < kLeastOthers || uneven < kUneven * others) return std::nullopt;
    return SampleTrain{(last - times[first]) / beats_kept, last};
  }
};

}  // namespace redbee
