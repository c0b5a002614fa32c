// Tracks of what a vehicle says of its mount or its lens.
#pragma once

#include <gtest/gtest.h>

#include "redbee/geometry/time.hpp"

namespace redbee::test {

inline ImuTime at(double t_s) { return ImuTime(std::chrono::seconds(1000)) + fromSeconds(t_s); }

/// With the samples of a second, a tenth of a second apart.
template <typename Track, typename Parameters, typename SampleAt>
Track sampledTrack(const Parameters& parameters, const SampleAt& sampleAt) {
  Track track(parameters);
  for (int i = 0; i <= 10; ++i) EXPECT_TRUE(track.add(sampleAt(0.1 * i)));
  return track;
}

}  // namespace redbee::test
