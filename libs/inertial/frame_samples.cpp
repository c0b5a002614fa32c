#include "redbee/inertial/frame_samples.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace redbee {
namespace {

/// Accelerometer samples before the first frame that are averaged for the vertical.
constexpr Duration kVerticalWindow = std::chrono::milliseconds(500);
constexpr double kCoverageTolerance = 0.01;  // s: the newest sample may lie this far before the exposure
constexpr Duration kMemory =
    std::chrono::seconds(1);  // of samples kept before the filter's time, for a restart

}  // namespace

FrameSamples::FrameSamples(const InertialParameters& parameters)
    : timeshift_(fromSeconds(parameters.extrinsics.timeshift_s)),
      max_gap_s_(parameters.max_imu_gap_s),
      gyro_correction_(parameters.gyro_correction),
      check_(parameters.imu_limits),
      imu_(parameters.max_frame_gap_s) {
  if (parameters.gimbal.enabled) mount_.emplace(parameters.gimbal);
  if (parameters.lens.enabled) lens_.emplace(parameters.lens, timeshift_);
}

bool FrameSamples::add(const ImuSample& sample) {
  if (!isPlausibleTime(sample.time) || !sample.gyro.allFinite() || !sample.accel.allFinite()) return false;
  const bool is_own = rhythm_.isKeptBy(sample.time);
  if (rhythm_.takeWereMixed()) {
    imu_.clear();
    were_mixed_ = true;
  }
  if (!is_own) {
    ++foreign_;
    return true;
  }
  for (const ImuSample& accepted : check_.filter(sample)) {
    imu_.add({accepted.time, gyro_correction_ * accepted.gyro, accepted.accel});
  }
  return true;
}

bool FrameSamples::cover(CameraTime frame) const {
  return isPlausibleTime(frame) && !imu_.empty() && imu_.newest() >= imuTime(frame);
}

double FrameSamples::outageAt(CameraTime frame) const {
  if (imu_.empty()) return std::numeric_limits<double>::infinity();
  const ImuTime time = imuTime(frame);
  return seconds(std::max(time - imu_.newest(), imu_.oldest() - time));
}

bool FrameSamples::wereRefused(CameraTime from_frame, CameraTime to_frame) const {
  return check_.refusedOn(imuTime(from_frame), imuTime(to_frame)) > 0;
}

std::vector<ImuSample> FrameSamples::forVertical(CameraTime frame) const {
  if (imu_.empty()) return {};
  const ImuTime time = imuTime(frame);
  std::vector<ImuSample> samples = imu_.samplesOn(time - kVerticalWindow, time);
  if (!samples.empty()) return samples;
  samples = imu_.samplesOn(time, time + fromSeconds(max_gap_s_));
  if (samples.size() > 1) samples.resize(1);
  return samples;
}

bool FrameSamples::isMissing(const ImuSpan& span) {
  return span.measured == 0 && std::max(span.longest_gap_s, span.extrapolated_s) > kCoverageTolerance;
}

bool FrameSamples::hasGap(const ImuSpan& span) const {
  return span.longest_gap_s > max_gap_s_ || span.extrapolated_s > kCoverageTolerance;
}

void FrameSamples::eraseBefore(CameraTime frame) {
  const ImuTime horizon = imuTime(frame) - kMemory;
  imu_.eraseBefore(horizon);
  check_.eraseBefore(horizon);
  if (mount_) mount_->eraseBefore(horizon);
  if (lens_) lens_->eraseBefore(horizon);
}

}  // namespace redbee
