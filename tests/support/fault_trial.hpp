// Compares a flight that is disturbed for one second with the undisturbed flight: errors during the
// disturbance, and number of frames until recovery. A frame agrees if its homography is fused from the same
// sources and within kSamePx of the undisturbed one, its mask is GOOD and overlaps the undisturbed one by
// kSameIoU. Exact equality cannot be expected, as filters have memory.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "redbee/geometry/row_major.hpp"
#include "tests/support/stack_run.hpp"

namespace redbee::test {

constexpr int kFaultFrames = 110;
constexpr int kFaultBegin = 40;  ///< the first frame that is disturbed
constexpr int kFaultEnd = 64;    ///< the first frame after the disturbance: one second
constexpr int kFaultWidth = 320;
constexpr int kFaultHeight = 240;
constexpr double kSamePx = 0.15;
constexpr double kSameIoU = 0.6;
constexpr int kComparablePx = 60;  ///< the overlap of smaller masks (union) is not compared

/// A car on grass beside a facade, at half the usual resolution.
inline StackFlight faultFlight(int frames = kFaultFrames) {
  StackFlight flight = stackFlight(halfSize(simulation::twoPlanes(3)), frames);
  flight.configuration.visual.tracker.grid_px = 8;
  return flight;
}
inline const StackFlight& undisturbedFlight() {
  static const StackFlight flight = faultFlight();
  return flight;
}
inline const StackOutput& undisturbedOutput() {
  static const StackOutput output = StackRun(undisturbedFlight()).run();
  return output;
}

inline int64_t beginTime(const StackFlight& flight) { return flight.frame_utimes[kFaultBegin]; }
inline int64_t endTime(const StackFlight& flight) { return flight.frame_utimes[kFaultEnd]; }
inline bool isDisturbed(const StackFlight& flight, int64_t utime) {
  return utime >= beginTime(flight) && utime < endTime(flight);
}

inline cv::Mat maskOf(const foreground_t& foreground) {
  return cv::imdecode(foreground.mask, cv::IMREAD_GRAYSCALE);
}

inline bool agrees(const StackOutput& output, const StackOutput& expected, int64_t utime) {
  const auto fused = output.fused.find(utime);
  const auto foreground = output.foreground.find(utime);
  if (fused == output.fused.end() || foreground == output.foreground.end()) return false;
  const fused_homography_t& undisturbed = expected.fused.at(utime);
  if (fused->second.source != undisturbed.source ||
      fused->second.utime_previous != undisturbed.utime_previous)
    return false;
  const Eigen::Matrix3d H = Eigen::Map<const RowMajor3d>(undisturbed.step.H);
  if (groundError(fused->second, H) > kSamePx || foreground->second.status != 0) return false;
  const cv::Mat mask = maskOf(foreground->second);
  const cv::Mat undisturbed_mask = maskOf(expected.foreground.at(utime));
  const int both = cv::countNonZero(mask | undisturbed_mask);
  return both < kComparablePx || cv::countNonZero(mask & undisturbed_mask) >= kSameIoU * both;
}

/// Effect of a disturbance.
struct Damage {
  int frames_to_recovery = 0;       ///< after the disturbance, until all following frames agree
  double worst_px = 0;              ///< largest error of the homography in disturbed frames
  int without_homography = 0;       ///< disturbed frames
  int without_mask = 0;             ///< disturbed frames without a GOOD mask
  double worst_false_fraction = 0;  ///< of the image, in masks with status GOOD
};

inline Damage assess(const StackOutput& output, const StackFlight& flight) {
  Damage damage;
  for (int k = 1; k < kFaultFrames; ++k) {
    const int64_t utime = flight.frame_utimes[static_cast<size_t>(k)];
    const bool disturbed = k >= kFaultBegin && k < kFaultEnd;
    const auto fused = output.fused.find(utime);
    const auto foreground = output.foreground.find(utime);
    const bool trusted = foreground != output.foreground.end() && foreground->second.status == 0;
    if (trusted) {
      const cv::Mat wrong = maskOf(foreground->second) & (flight.masks[static_cast<size_t>(k)] == 0);
      damage.worst_false_fraction =
          std::max(damage.worst_false_fraction,
                   cv::countNonZero(wrong) / static_cast<double>(kFaultWidth * kFaultHeight));
    }
    if (k >= kFaultEnd && !agrees(output, undisturbedOutput(), utime))
      damage.frames_to_recovery = k - kFaultEnd + 1;
    if (!disturbed) continue;
    damage.without_mask += trusted ? 0 : 1;
    const bool has_homography = fused != output.fused.end() && fused->second.source != 0;
    damage.without_homography += has_homography ? 0 : 1;
    const bool is_step =
        has_homography && fused->second.utime_previous == flight.frame_utimes[static_cast<size_t>(k - 1)];
    if (is_step) {
      damage.worst_px =
          std::max(damage.worst_px, groundError(fused->second, flight.homographies[static_cast<size_t>(k)]));
    }
  }
  return damage;
}

/// Prints the figures and checks them: recovery within `within_frames`, and no GOOD mask with more than
/// `most_false_fraction` false area.
inline Damage expectRecovery(const std::string& fault, const StackOutput& output, const StackFlight& flight,
                             int within_frames, double most_false_fraction = 0.04) {
  const Damage damage = assess(output, flight);
  std::printf(
      "%-34s recovered after %2d frames; of %d disturbed: %2d without homography, worst %.2f px, %2d without "
      "mask; false at most %.2f %%\n",
      fault.c_str(), damage.frames_to_recovery, kFaultEnd - kFaultBegin, damage.without_homography,
      damage.worst_px, damage.without_mask, 100 * damage.worst_false_fraction);
  EXPECT_LE(damage.frames_to_recovery, within_frames) << fault;
  EXPECT_LT(damage.worst_false_fraction, most_false_fraction)
      << fault << ": a wrong mask has the status GOOD";
  return damage;
}

/// The flight with `change` applied to the messages of `channel` during the disturbance.
template <typename Message>
StackFlight withChanged(StackFlight flight, const std::string& channel,
                        const std::function<void(Message&)>& change) {
  for (SensorMessage& sent : flight.messages) {
    if (sent.channel != channel || !isDisturbed(flight, sent.utime)) continue;
    Message message;
    if (!decodeMessage(sent.data.data(), static_cast<int>(sent.data.size()), message)) {
      throw std::logic_error("the simulated flight holds a message that does not decode");
    }
    change(message);
    sent = encoded(message);
  }
  return flight;
}

}  // namespace redbee::test
