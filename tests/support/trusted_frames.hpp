// Counts the frames of a disturbed flight whose mask is trusted, and the wild masks among them.
#pragma once

#include <cstdio>
#include <set>

#include "tests/support/fault_trial.hpp"

namespace redbee::test {

/// The detector's first frames, which it learns from.
constexpr int kLearningFrames = 16;
/// Of the image: a mask with status GOOD and more false area than this is wild.
constexpr double kWildFraction = 0.04;

struct TrustedFrames {
  int expected = 0;  ///< after the learning, whose image arrived
  int trusted = 0;   ///< of these, with a GOOD mask
  int wild = 0;      ///< of these, with far too much false area

  TrustedFrames& operator+=(const TrustedFrames& other) {
    expected += other.expected;
    trusted += other.trusted;
    wild += other.wild;
    return *this;
  }
  void print(const char* name) const {
    std::printf("%-44s trusted %3d of %3d, wild %d\n", name, trusted, expected, wild);
  }
};

inline TrustedFrames trustedFrames(const StackOutput& output, const StackFlight& flight,
                                   const std::set<int64_t>& without_image = {},
                                   int from_frame = kLearningFrames) {
  TrustedFrames frames;
  for (int k = from_frame; k < static_cast<int>(flight.frame_utimes.size()); ++k) {
    const int64_t utime = flight.frame_utimes[static_cast<size_t>(k)];
    if (without_image.count(utime) > 0) continue;
    ++frames.expected;
    const auto foreground = output.foreground.find(utime);
    if (foreground == output.foreground.end() || foreground->second.status != foreground_t::GOOD) {
      continue;
    }
    ++frames.trusted;
    const cv::Mat wrong = maskOf(foreground->second) & (flight.masks[static_cast<size_t>(k)] == 0);
    frames.wild += cv::countNonZero(wrong) > kWildFraction * static_cast<double>(wrong.total()) ? 1 : 0;
  }
  return frames;
}

}  // namespace redbee::test
