// IMU samples, and the mount's, by frame; converts between the camera's and the IMU's clock.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "redbee/geometry/time.hpp"
#include "redbee/inertial/imu_buffer.hpp"
#include "redbee/inertial/imu_rhythm.hpp"
#include "redbee/inertial/imu_sample_check.hpp"
#include "redbee/inertial/inertial_filter.hpp"
#include "redbee/inertial/lens_track.hpp"
#include "redbee/inertial/mount_track.hpp"

namespace redbee {

/// Buffers the plausible samples. Frames are given by their times on the camera's clock.
class FrameSamples {
 public:
  explicit FrameSamples(const InertialParameters& parameters);

  /// Refuses a sample that is not finite or has an implausible time, and then returns false.
  bool add(const ImuSample& sample);
  /// Samples of another IMU (ImuRhythm), which were not used, since the last call.
  int takeForeign() { return std::exchange(foreign_, 0); }
  /// Whether samples before were of two IMUs mixed, since the last call; they are discarded.
  bool takeWereMixed() { return std::exchange(were_mixed_, false); }
  ImuTime imuTime(CameraTime frame) const { return toImu(frame, timeshift_); }

  /// True if the samples reach a frame's exposure.
  bool cover(CameraTime frame) const;
  /// Of a gimbal; ignored where the camera is fixed to the IMU, whose mount is known and covers every frame.
  bool addMount(const MountSample& sample) { return !mount_ || mount_->add(sample); }
  bool coverMount(CameraTime frame) const { return !mount_ || mount_->reaches(imuTime(frame)); }
  MountRotation mountAt(CameraTime frame) const {
    return mount_ ? mount_->at(imuTime(frame)) : MountRotation();
  }
  /// Of a lens that zooms; ignored where it does not.
  bool addLens(const LensSample& sample) { return !lens_ || lens_->add(sample); }
  bool coverLens(CameraTime frame) const { return !lens_ || lens_->reaches(imuTime(frame)); }
  Zoom zoomAt(CameraTime frame) const { return lens_ ? lens_->at(imuTime(frame)) : Zoom(); }
  /// s, from a frame to the nearest sample, which may be a later one after a jump of the IMU's clock.
  double outageAt(CameraTime frame) const;
  /// True if samples were refused in the interval of two frames.
  bool wereRefused(CameraTime from_frame, CameraTime to_frame) const;
  /// Samples for the initial vertical at a frame, oldest first: those just before it, otherwise the first one
  /// after it.
  std::vector<ImuSample> forVertical(CameraTime frame) const;

  bool empty() const { return imu_.empty(); }
  /// On [begin, end]; precondition: not empty.
  ImuSpan span(ImuTime begin, ImuTime end) const { return imu_.span(begin, end); }
  /// True if the span has no sample in it or right next to it.
  static bool isMissing(const ImuSpan& span);
  /// True if a gap in the span is long enough to be reported.
  bool hasGap(const ImuSpan& span) const;
  /// Keeps the samples that a restart at the frame would need.
  void eraseBefore(CameraTime frame);

 private:
  Duration timeshift_;
  double max_gap_s_;
  Eigen::Matrix3d gyro_correction_;
  ImuRhythm rhythm_;
  int foreign_ = 0;
  bool were_mixed_ = false;
  ImuSampleCheck check_;
  ImuBuffer imu_;
  std::optional<MountTrack> mount_;  ///< of a gimbal
  std::optional<LensTrack> lens_;    ///< of one that zooms
};

}  // namespace redbee
