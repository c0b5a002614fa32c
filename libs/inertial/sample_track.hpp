// Samples of what a vehicle says now and then, in order of their times.
#pragma once

#include <algorithm>
#include <cstddef>
#include <deque>

#include "redbee/geometry/time.hpp"

namespace redbee {

/// The first that is not before `time`.
template <typename Sample>
typename std::deque<Sample>::const_iterator firstFrom(const std::deque<Sample>& samples, ImuTime time) {
  return std::lower_bound(samples.begin(), samples.end(), time,
                          [](const Sample& each, ImuTime t) { return each.time < t; });
}

/// Of two with the same time the later one counts. A clock that was set back forgets what came before.
template <typename Sample>
void insertInOrder(std::deque<Sample>& samples, const Sample& sample) {
  constexpr std::size_t kMost = 20000;  // at 200 Hz 100 s, which no frame waits for
  constexpr double kSetBack_s = 2;      // a sample that is older than the newest by this is of another clock
  if (!samples.empty() && seconds(samples.back().time - sample.time) > kSetBack_s) samples.clear();
  const auto place = samples.begin() + (firstFrom(samples, sample.time) - samples.cbegin());
  if (place != samples.end() && place->time == sample.time) {
    *place = sample;
    return;
  }
  samples.insert(place, sample);
  if (samples.size() > kMost) samples.pop_front();
}

/// Those before `time` but the last, which is still one end of an interpolation, and in any case the newest
/// `kept`.
template <typename Sample>
void eraseUpTo(std::deque<Sample>& samples, ImuTime time, std::size_t kept = 1) {
  while (samples.size() > kept && samples[1].time <= time) samples.pop_front();
}

}  // namespace redbee
