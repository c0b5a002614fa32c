#include "redbee/inertial/inertial_filter.hpp"

#include "redbee/inertial/corrections.hpp"
#include "redbee/inertial/error_state.hpp"
#include "redbee/inertial/frame_samples.hpp"
#include "redbee/inertial/homography_measurement.hpp"
#include "redbee/inertial/initial_state.hpp"
#include "redbee/inertial/row_motion.hpp"
#include "redbee/inertial/vision_comparison.hpp"

namespace redbee {
namespace {

constexpr double kMaxOutage = 0.5;  // s without IMU after which the state is discarded

InertialHomography nothing(CameraTime frame_before, CameraTime frame, InertialStatus status) {
  InertialHomography result;
  result.time_previous = frame_before;
  result.time = frame;
  result.status = status;
  return result;
}

}  // namespace

class InertialFilter::Implementation {
 public:
  Implementation(const Camera& camera, const InertialParameters& parameters)
      : parameters_(parameters),
        propagation_{parameters.noise, parameters.gravity, parameters.max_imu_gap_s},
        camera_(camera),
        samples_(parameters),
        altitude_(parameters),
        vision_(parameters),
        comparison_(parameters.extrinsics) {}

  bool addImu(const ImuSample& sample) {
    const bool added = samples_.add(sample);
    if (added) comparison_.timeshift.addGyro(sample.time, parameters_.gyro_correction * sample.gyro);
    return added;
  }
  int takeForeignSamples() { return samples_.takeForeign(); }

  bool addAltitude(const AltitudeSample& sample) { return altitude_.add(sample); }

  bool covers(CameraTime frame) const {
    return samples_.cover(frame + fromSeconds(halfReadout(camera_.intrinsics())));
  }

  InertialHomography advanceTo(CameraTime frame) {
    InertialHomography result = stepTo(frame);
    result.row_motion = rowMotionAt(frame);
    return result;
  }

  CorrectionReport correct(const HomographyObservation& observation) {
    const bool belongs = state_ && previous_frame_ && !corrected_ && observation.time == *frame_ &&
                         observation.time_previous == *previous_frame_;
    if (!belongs) return {};
    comparison_.note(*state_, camera_, p_IC(), observation.time_previous, observation.time, observation.H,
                     observation.covariance);
    const NavigationState before = *state_;
    const CorrectionReport report = vision_.correct(*state_, observation, camera_, p_IC());
    corrected_ = report.applied;
    keepAboveGround(*state_, p_IC());
    if (!isValid(*state_)) {
      state_ = before;
      return {};
    }
    return report;
  }

  std::optional<NominalState> state() const {
    if (!state_) return std::nullopt;
    return NominalState{*frame_,           state_->R_GI,       state_->v_GI, cameraHeight(*state_, p_IC()),
                        state_->gyro_bias, state_->accel_bias, state_->R_CI};
  }

  const std::optional<FilterSnapshot>& snapshot() const { return known_; }
  const VisionComparison& comparison() const { return comparison_; }
  bool isAtFirstFrame() const { return state_ && !has_moved_; }

  SnapshotCheck warmStart(const FilterSnapshot& known) {
    if (!isAtFirstFrame()) return SnapshotCheck::kNotWanted;
    const SnapshotCheck check = validate(known, *frame_, parameters_);
    if (check == SnapshotCheck::kAccepted) {
      known_ = known;
      state_ = initialState(*frame_, samples_.forVertical(*frame_), parameters_, known_);
    }
    return check;
  }

 private:
  const Eigen::Vector3d& p_IC() const { return parameters_.extrinsics.p_IC; }

  InertialHomography stepTo(CameraTime frame) {
    if (!isPlausibleTime(frame) || (frame_ && frame == *frame_)) {
      return nothing(frame_.value_or(frame), frame, InertialStatus::kClockJump);
    }
    if (samples_.takeWereMixed()) {
      comparison_ = VisionComparison(parameters_.extrinsics);
      return startAfresh(frame);
    }
    if (!frame_) return start(frame, InertialStatus::kInitialising);
    const double interval = seconds(frame - *frame_);
    if (interval < 0 || interval > parameters_.max_frame_gap_s) {
      return start(frame, InertialStatus::kClockJump);
    }
    if (samples_.empty()) return coast(frame);
    const ImuSpan span = samples_.span(samples_.imuTime(*frame_), samples_.imuTime(frame));
    return FrameSamples::isMissing(span) ? coast(frame) : move(frame, span);
  }

  std::optional<RowMotion> rowMotionAt(CameraTime frame) const {
    const double half_s = halfReadout(camera_.intrinsics());
    if (half_s == 0 || !state_ || frame_ != frame || !comparison_.agreement.agrees()) return std::nullopt;
    return rowMotion(*state_, p_IC(), samples_, frame, fromSeconds(half_s));
  }

  InertialHomography start(CameraTime frame, InertialStatus status) {
    InertialHomography result = nothing(frame_.value_or(frame), frame, status);
    const std::vector<ImuSample> before = samples_.forVertical(frame);
    forgetFrames();
    if (before.empty()) {
      state_.reset();
      return nothing(frame, frame, status == InertialStatus::kClockJump ? status : InertialStatus::kNoImu);
    }
    state_ = initialState(frame, before, parameters_, known_);
    frame_ = frame;
    altitude_.eraseBefore(samples_.imuTime(frame));
    vision_.restart();
    return result;
  }

  void forgetFrames() {
    frame_.reset();
    previous_frame_.reset();
    corrected_ = false;
  }

  /// No sample in the interval: the last one is held for a while, then the state is discarded.
  InertialHomography coast(CameraTime frame) {
    InertialHomography result = nothing(*frame_, frame, statusOf(frame, InertialStatus::kNoImu));
    if (samples_.outageAt(frame) > kMaxOutage) {
      forgetFrames();
      state_.reset();
      return result;
    }
    integrate(frame);
    return isValid(*state_) ? result : startAfresh(frame);
  }

  InertialHomography move(CameraTime frame, const ImuSpan& span) {
    const bool gap = samples_.hasGap(span);
    InertialHomography result =
        nothing(*frame_, frame, statusOf(frame, gap ? InertialStatus::kImuGap : InertialStatus::kGood));
    correctByGravity(*state_, span, parameters_, vision_.secondsSinceApplied(*frame_));
    integrate(frame);
    if (!isValid(*state_)) return startAfresh(frame);
    describe(*state_, camera_, p_IC(), result);
    if (!result.H.allFinite() || !result.covariance.allFinite()) return startAfresh(frame);
    if (!comparison_.agreement.agrees()) {
      result.status = InertialStatus::kDisagreement;
      return result;
    }
    result.valid = true;
    known_ = snapshotOf(*state_, frame, p_IC());
    return result;
  }

  /// Refused samples take precedence over missing ones.
  InertialStatus statusOf(CameraTime frame, InertialStatus otherwise) const {
    return samples_.wereRefused(*frame_, frame) ? InertialStatus::kBadSamples : otherwise;
  }

  InertialHomography startAfresh(CameraTime frame) {
    known_.reset();
    return start(frame, InertialStatus::kInitialising);
  }

  /// Moves the state to the frame, stopping at each altitude on the way.
  void integrate(CameraTime frame) {
    ImuTime time = samples_.imuTime(*frame_);
    const ImuTime end = samples_.imuTime(frame);
    altitude_.correctLate(*state_, time);
    clonePose(*state_);
    while (const std::optional<AltitudeSample> altitude = altitude_.next(end)) {
      integrateTo(time, altitude->time);
      time = altitude->time;
      altitude_.correct(*state_, *altitude, 0);
    }
    integrateTo(time, end);
    keepAboveGround(*state_, p_IC());
    samples_.eraseBefore(frame);
    previous_frame_ = frame_;
    frame_ = frame;
    corrected_ = false;
    has_moved_ = true;
  }

  void integrateTo(ImuTime begin, ImuTime end) {
    if (end <= begin) return;
    const ImuSpan span = samples_.span(begin, end);
    for (std::size_t i = 1; i < span.knots.size(); ++i) {
      propagate(*state_, span.knots[i - 1], span.knots[i], propagation_);
    }
  }

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

InertialFilter::InertialFilter(const Camera& camera, const InertialParameters& parameters)
    : implementation_(std::make_unique<Implementation>(camera, parameters)) {}
InertialFilter::~InertialFilter() = default;
InertialFilter::InertialFilter(InertialFilter&&) noexcept = default;
InertialFilter& InertialFilter::operator=(InertialFilter&&) noexcept = default;

bool InertialFilter::addImu(const ImuSample& sample) { return implementation_->addImu(sample); }
int InertialFilter::takeForeignSamples() { return implementation_->takeForeignSamples(); }
bool InertialFilter::addAltitude(const AltitudeSample& sample) {
  return implementation_->addAltitude(sample);
}
bool InertialFilter::covers(CameraTime frame) const { return implementation_->covers(frame); }
InertialHomography InertialFilter::advanceTo(CameraTime frame) { return implementation_->advanceTo(frame); }
CorrectionReport InertialFilter::correct(const HomographyObservation& observation) {
  return implementation_->correct(observation);
}
std::optional<NominalState> InertialFilter::state() const { return implementation_->state(); }
const std::optional<FilterSnapshot>& InertialFilter::snapshot() const { return implementation_->snapshot(); }
bool InertialFilter::isAtFirstFrame() const { return implementation_->isAtFirstFrame(); }
const VisionAgreement& InertialFilter::agreement() const { return implementation_->comparison().agreement; }
const TimeshiftMonitor& InertialFilter::timeshift() const { return implementation_->comparison().timeshift; }
SnapshotCheck InertialFilter::warmStart(const FilterSnapshot& known) {
  return implementation_->warmStart(known);
}

}  // namespace redbee
