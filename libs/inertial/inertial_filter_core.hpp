// The error-state filter behind InertialFilter, which hands it corrections in order of time.
#pragma once

#include <optional>
#include <vector>

#include "redbee/inertial/corrections.hpp"
#include "redbee/inertial/error_state.hpp"
#include "redbee/inertial/filter_checkpoint.hpp"
#include "redbee/inertial/frame_samples.hpp"
#include "redbee/inertial/homography_measurement.hpp"
#include "redbee/inertial/inertial_filter.hpp"
#include "redbee/inertial/initial_state.hpp"
#include "redbee/inertial/row_motion.hpp"
#include "redbee/inertial/vision_comparison.hpp"

namespace redbee {

class InertialFilterCore {
 public:
  InertialFilterCore(const Camera& camera, const InertialParameters& parameters)
      : parameters_(parameters),
        propagation_{parameters.noise, parameters.gravity, parameters.max_imu_gap_s},
        camera_(camera),
        samples_(parameters),
        altitude_(parameters),
        vision_(parameters),
        comparison_(parameters.extrinsics) {}

  bool addImu(const ImuSample& sample) {
    const bool added = samples_.add(sample);
    // What turns a gimbal is not in the gyro's rates.
    if (added && !parameters_.gimbal.enabled)
      comparison_.timeshift.addGyro(sample.time, parameters_.gyro_correction * sample.gyro);
    return added;
  }
  int takeForeignSamples() { return samples_.takeForeign(); }

  bool addMount(const MountSample& sample) { return samples_.addMount(sample); }
  bool coversMount(CameraTime frame) const { return samples_.coverMount(frame); }
  bool addLens(const LensSample& sample) { return samples_.addLens(sample); }
  bool coversLens(CameraTime frame) const { return samples_.coverLens(frame); }

  bool addAltitude(const AltitudeSample& sample) { return altitude_.add(sample); }

  bool covers(CameraTime frame) const {
    return samples_.cover(frame + fromSeconds(halfReadout(camera_.intrinsics())));
  }

  InertialHomography advanceTo(CameraTime frame) {
    InertialHomography result = stepTo(frame);
    result.row_motion = rowMotionAt(frame);
    result.zoom = samples_.zoomAt(frame);
    return result;
  }

  /// Whether an observation has been compared with the IMU before: a frame may be passed again.
  enum class Comparison { kDue, kDone };
  /// Of the last two frames, and once.
  CorrectionReport correct(const HomographyObservation& observation, Comparison comparison);

  std::optional<NominalState> state() const {
    if (!state_) return std::nullopt;
    return NominalState{*frame_,           state_->R_GI,       state_->v_GI, cameraHeight(*state_, p_IC()),
                        state_->gyro_bias, state_->accel_bias, state_->R_CI};
  }

  const std::optional<FilterSnapshot>& snapshot() const { return known_; }
  const VisionComparison& comparison() const { return comparison_; }
  bool isAtFirstFrame() const { return state_ && !has_moved_; }

  /// What the frames have made of it, to return to while a second of samples is kept; std::nullopt without a
  /// state.
  std::optional<FilterCheckpoint> checkpoint() const {
    if (!state_ || !previous_frame_) return std::nullopt;
    return FilterCheckpoint{*previous_frame_, *frame_, *state_, altitude_, vision_, known_};
  }
  void returnTo(const FilterCheckpoint& at) {
    previous_frame_ = at.previous_frame;
    frame_ = at.frame;
    state_ = at.state;
    altitude_ = at.altitude;
    vision_ = at.vision;
    known_ = at.known;
    corrected_ = false;
  }

  SnapshotCheck warmStart(const FilterSnapshot& known) {
    if (!isAtFirstFrame()) return SnapshotCheck::kNotWanted;
    const SnapshotCheck check = validate(known, *frame_, parameters_);
    if (check == SnapshotCheck::kAccepted) {
      known_ = known;
      begin(*frame_, samples_.forVertical(*frame_));
    }
    return check;
  }

 private:
  const Eigen::Vector3d& p_IC() const { return parameters_.extrinsics.p_IC; }

  InertialHomography stepTo(CameraTime frame);

  std::optional<RowMotion> rowMotionAt(CameraTime frame) const {
    const double half_s = halfReadout(camera_.intrinsics());
    if (half_s == 0 || !state_ || frame_ != frame || !comparison_.agreement.agrees()) return std::nullopt;
    if (!state_->mount.is_known) return std::nullopt;
    return rowMotion(*state_, p_IC(), samples_, frame, fromSeconds(half_s));
  }

  InertialHomography start(CameraTime frame, InertialStatus status);

  void begin(CameraTime frame, const std::vector<ImuSample>& before) {
    state_ = initialState(frame, before, parameters_, known_);
    state_->mount = state_->mount_clone = samples_.mountAt(frame);
    state_->zoom = state_->zoom_clone = samples_.zoomAt(frame);
  }

  void forgetFrames() {
    frame_.reset();
    previous_frame_.reset();
    corrected_ = false;
  }

  /// No sample in the interval: the last one is held for a while, then the state is discarded.
  InertialHomography coast(CameraTime frame);

  InertialHomography move(CameraTime frame, const ImuSpan& span);

  /// Refused samples take precedence over missing ones.
  InertialStatus statusOf(CameraTime frame, InertialStatus otherwise) const {
    return samples_.wereRefused(*frame_, frame) ? InertialStatus::kBadSamples : otherwise;
  }

  InertialHomography startAfresh(CameraTime frame) {
    known_.reset();
    return start(frame, InertialStatus::kInitialising);
  }

  /// Moves the state to the frame, stopping at each altitude on the way.
  void integrate(CameraTime frame);

  void integrateTo(ImuTime begin, ImuTime end);

  InertialParameters parameters_;
  PropagationParameters propagation_;
  Camera camera_;
  FrameSamples samples_;
  AltitudeCorrection altitude_;
  VisionCorrection vision_;
  VisionComparison comparison_;  ///< survives a restart
  std::optional<NavigationState> state_;
  std::optional<FilterSnapshot> known_;  ///< of the last valid state: survives a restart
  std::optional<CameraTime> frame_;
  std::optional<CameraTime> previous_frame_;
  bool corrected_ = false;  ///< by vision, for the last two frames
  bool has_moved_ = false;  ///< past the first frame
};

}  // namespace redbee
