// Estimates the ground homography between frames from IMU samples (libs/README.md, "Inertial homography").
//
// An error-state Kalman filter over attitude, velocity, height, gyro and accelerometer bias. It dead-reckons
// on the IMU and is corrected by gravity (slowly, gated), by an altimeter where there is one, and by the
// visual part of the previous fused homography, which measures t / h. The pose at the previous frame is part
// of the state (a stochastic clone), so that the covariance of the frame-to-frame homography is propagated.
//
// The filter stays at the last frame until it is advanced to the next one, so that a correction for the last
// frame is applied to the right state. It uses only the times inside its samples.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "redbee/geometry/angle.hpp"
#include "redbee/geometry/camera.hpp"
#include "redbee/geometry/homography.hpp"
#include "redbee/geometry/time.hpp"
#include "redbee/inertial/filter_snapshot.hpp"
#include "redbee/inertial/gimbal_parameters.hpp"
#include "redbee/inertial/imu.hpp"
#include "redbee/inertial/imu_sample_check.hpp"
#include "redbee/inertial/inertial_homography.hpp"
#include "redbee/inertial/lens_parameters.hpp"
#include "redbee/inertial/lens_track.hpp"
#include "redbee/inertial/mount_track.hpp"
#include "redbee/inertial/timeshift_monitor.hpp"
#include "redbee/inertial/vision_agreement.hpp"

namespace redbee {

struct InertialParameters {
  InertialExtrinsics extrinsics;
  ImuNoise noise;
  ImuSampleLimits imu_limits;
  GimbalParameters gimbal;
  LensParameters lens;
  double gravity = 9.81;              ///< m/s^2
  double start_velocity_sigma = 3.0;  ///< m/s: of the drone's velocity at the first frame
  /// Turns measured rates into those of a gyro with axes of equal scale at right angles; biases are of its
  /// result.
  Eigen::Matrix3d gyro_correction = Eigen::Matrix3d::Identity();
  Eigen::Vector3d gyro_bias = Eigen::Vector3d::Zero();   ///< rad/s: prior mean
  Eigen::Vector3d accel_bias = Eigen::Vector3d::Zero();  ///< m/s^2
  double gyro_bias_sigma = 0.01;                         ///< rad/s: turn-on bias of the gyro
  double accel_bias_sigma = 0.15;                        ///< m/s^2: turn-on bias of the accelerometer
  double extrinsic_rotation_sigma_deg = 0.1;             ///< deg: standard deviation of the calibrated R_CI
  double gravity_gate = 0.5;  ///< m/s^2: | |accel| - g | above which gravity does not correct the attitude
  double gravity_sigma =
      1.0;  ///< m/s^2: the drone's own acceleration, which specific force contains beside gravity
  double gravity_correlation_s =
      2.0;                     ///< s: correlation time of that acceleration; makes gravity's correction slow
  double max_imu_gap_s = 0.1;  ///< s: a longer time without IMU samples is a gap
  double max_frame_gap_s = 2.0;  ///< s: frames further apart than this restart the filter
  /// Frames over which vision's errors are correlated (the same relief stays in view): each correction's
  /// covariance is scaled by it.
  double feedback_correlation_frames = 8.0;
  double innovation_gate_probability = 0.999;  ///< chi-square gate of every correction

  /// rad
  double extrinsicRotationSigma() const { return extrinsic_rotation_sigma_deg * kDegree; }
};

/// A homography of the ground between two consecutive frames, measured independently of the IMU: vision's
/// input to the fusion. (Feeding back the fused homography would use the IMU twice.)
struct HomographyObservation {
  CameraTime time_previous{};
  CameraTime time{};
  Eigen::Matrix3d H;    ///< ideal pixels, h33 = 1
  Matrix8d covariance;  ///< scaled
};

/// A correction's innovation, for monitoring.
struct CorrectionReport {
  bool applied = false;
  double test_ratio = 0;  ///< squared Mahalanobis distance over the gate; above 1 the correction is rejected
};

/// The filter's nominal state, for tests and monitoring.
struct NominalState {
  CameraTime time{};
  Eigen::Matrix3d R_GI;  ///< yaw free
  Eigen::Vector3d v_GI;  ///< m/s in G
  double camera_height_m = 0;
  Eigen::Vector3d gyro_bias;   ///< rad/s
  Eigen::Vector3d accel_bias;  ///< m/s^2
  Eigen::Matrix3d R_CI;        ///< the mounting at rest, corrected within the calibration's sigma
};

class InertialFilter {
 public:
  InertialFilter(const Camera& camera, const InertialParameters& parameters);
  ~InertialFilter();
  InertialFilter(InertialFilter&&) noexcept;
  InertialFilter& operator=(InertialFilter&&) noexcept;

  /// Samples may arrive late (they are sorted by time) or twice (ignored). Returns false for non-finite ones,
  /// which are refused. Implausible ones (ImuSampleCheck) are not used, and the status of their frame reports
  /// it.
  bool addImu(const ImuSample& sample);
  bool addAltitude(const AltitudeSample& sample);
  /// Of a gimbal, where the parameters enable it; otherwise it is ignored. False: refused, no rotation.
  bool addMount(const MountSample& sample);
  /// Of a lens that zooms, where the parameters enable it; otherwise it is ignored. False: refused.
  bool addLens(const LensSample& sample);
  /// Samples of a second IMU, which were not used, since the last call.
  int takeForeignSamples();

  /// True if the samples reach the exposure of this frame's last row.
  bool covers(CameraTime frame) const;
  /// True if the mount's samples reach the frame, or if it has no gimbal.
  bool coversMount(CameraTime frame) const;
  /// The same of the lens.
  bool coversLens(CameraTime frame) const;

  /// Advances the filter to this frame and returns the motion since the last one. Invalid times are reported
  /// in the status.
  InertialHomography advanceTo(CameraTime frame);

  /// Corrects the state at the last frame; of an earlier one within 0.75 s, as if it had come in time. Once.
  CorrectionReport correct(const HomographyObservation& observation);
  /// The same of several, in order of time: late ones that arrive together cost one way back.
  std::vector<CorrectionReport> correct(const std::vector<HomographyObservation>& observations);

  std::optional<NominalState> state() const;

  /// Of the observations that correct() was given. While vision contradicts the IMU, advanceTo() returns no
  /// homography; the state is still corrected, so that the IMU is used again once they agree.
  const VisionAgreement& agreement() const;
  /// Of the same observations: the time shift that they show beyond the configured one.
  const TimeshiftMonitor& timeshift() const;

  /// Snapshot at the last frame with a valid motion; std::nullopt before the first.
  const std::optional<FilterSnapshot>& snapshot() const;
  /// True until the filter has been advanced past its first frame.
  bool isAtFirstFrame() const;
  /// At the first frame: initialises the state from another filter's snapshot. A refused snapshot changes
  /// nothing.
  SnapshotCheck warmStart(const FilterSnapshot& known);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace redbee
