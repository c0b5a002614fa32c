#include "redbee/inertial/frame_samples.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "redbee/inertial/seconds.hpp"

namespace redbee {
namespace {

/// s: accelerometer samples before the first frame that are averaged for the vertical.
constexpr double kVerticalWindow = 0.5;
constexpr double kCoverageTolerance = 0.01;  // s: the newest sample may lie this far before the exposure
constexpr double kMemory = 1.0;              // s of samples kept before the filter's time, for a restart

int64_t microseconds(double s) { return static_cast<int64_t>(std::llround(s * 1e6)); }

}  // namespace

FrameSamples::FrameSamples(const InertialParameters& parameters)
    : timeshift_us_(microseconds(parameters.extrinsics.timeshift_s)),
      max_gap_s_(parameters.max_imu_gap_s),
      check_(parameters.imu_limits),
      imu_(parameters.max_frame_gap_s) {}

bool FrameSamples::add(const ImuSample& sample) {
  if (!isPlausibleTime(sample.utime) || !sample.gyro.allFinite() || !sample.accel.allFinite()) return false;
  for (const ImuSample& accepted : check_.take(sample)) imu_.add(accepted);
  return true;
}

bool FrameSamples::cover(int64_t frame) const {
  return isPlausibleTime(frame) && !imu_.empty() && imu_.newest() >= imuTime(frame);
}

double FrameSamples::outageAt(int64_t frame) const {
  if (imu_.empty()) return std::numeric_limits<double>::infinity();
  const int64_t time = imuTime(frame);
  return seconds(std::max(time - imu_.newest(), imu_.oldest() - time));
}

bool FrameSamples::wereRefused(int64_t from_frame, int64_t to_frame) const {
  return check_.refusedOn(imuTime(from_frame), imuTime(to_frame)) > 0;
}

std::vector<ImuSample> FrameSamples::forVertical(int64_t frame) const {
  if (imu_.empty()) return {};
  const int64_t time = imuTime(frame);
  std::vector<ImuSample> samples = imu_.samplesOn(time - microseconds(kVerticalWindow), time);
  if (!samples.empty()) return samples;
  samples = imu_.samplesOn(time, time + microseconds(max_gap_s_));
  if (samples.size() > 1) samples.resize(1);
  return samples;
}

bool FrameSamples::isMissing(const ImuSpan& span) {
  return span.measured == 0 && std::max(span.longest_hole_s, span.extrapolated_s) > kCoverageTolerance;
}

bool FrameSamples::hasGap(const ImuSpan& span) const {
  return span.longest_hole_s > max_gap_s_ || span.extrapolated_s > kCoverageTolerance;
}

void FrameSamples::eraseBefore(int64_t frame) {
  const int64_t horizon = imuTime(frame) - microseconds(kMemory);
  imu_.eraseBefore(horizon);
  check_.eraseBefore(horizon);
}

}  // namespace redbee
