#include "redbee/inertial/inertial_filter_core.hpp"

#include "redbee/geometry/homography_quality.hpp"
#include "redbee/inertial/homography_measurement.hpp"
#include "redbee/inertial/initial_state.hpp"

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

CorrectionReport InertialFilterCore::correct(const HomographyObservation& observation,
                                             Comparison comparison) {
  const bool belongs = state_ && state_->isMountKnown() && previous_frame_ && !corrected_ &&
                       observation.time == *frame_ && observation.time_previous == *previous_frame_;
  if (!belongs) return {};
  if (comparison == Comparison::kDue) {
    comparison_.note(*state_, camera_, p_IC(), observation.time_previous, observation.time, observation.H,
                     observation.covariance);
  }
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

InertialHomography InertialFilterCore::stepTo(CameraTime frame) {
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

InertialHomography InertialFilterCore::start(CameraTime frame, InertialStatus status) {
  InertialHomography result = nothing(frame_.value_or(frame), frame, status);
  const std::vector<ImuSample> before = samples_.forVertical(frame);
  forgetFrames();
  if (before.empty()) {
    state_.reset();
    return nothing(frame, frame, status == InertialStatus::kClockJump ? status : InertialStatus::kNoImu);
  }
  begin(frame, before);
  frame_ = frame;
  altitude_.eraseBefore(samples_.imuTime(frame));
  vision_.restart();
  return result;
}

InertialHomography InertialFilterCore::coast(CameraTime frame) {
  InertialHomography result = nothing(*frame_, frame, statusOf(frame, InertialStatus::kNoImu));
  if (samples_.outageAt(frame) > kMaxOutage) {
    forgetFrames();
    state_.reset();
    return result;
  }
  integrate(frame);
  return isValid(*state_) ? result : startAfresh(frame);
}

InertialHomography InertialFilterCore::move(CameraTime frame, const ImuSpan& span) {
  const bool gap = samples_.hasGap(span);
  InertialHomography result =
      nothing(*frame_, frame, statusOf(frame, gap ? InertialStatus::kImuGap : InertialStatus::kGood));
  correctByGravity(*state_, span, parameters_, vision_.secondsSinceApplied(*frame_));
  integrate(frame);
  if (!isValid(*state_)) return startAfresh(frame);
  if (!state_->isMountKnown()) {
    result.status = InertialStatus::kNoMount;
    return result;
  }
  describe(*state_, camera_, p_IC(), result);
  if (!result.H.allFinite() || !result.covariance.allFinite()) return startAfresh(frame);
  if (!comparison_.agreement.agrees()) {
    result.status = InertialStatus::kDisagreement;
    return result;
  }
  if (!isUsable(result.H) || !isInformative(result.covariance)) {
    result.status = InertialStatus::kUncertain;
    return result;
  }
  result.valid = true;
  known_ = snapshotOf(*state_, frame, p_IC());
  return result;
}

void InertialFilterCore::integrate(CameraTime frame) {
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
  state_->mount = samples_.mountAt(frame);
  state_->zoom = samples_.zoomAt(frame);
  corrected_ = false;
  has_moved_ = true;
}

void InertialFilterCore::integrateTo(ImuTime begin, ImuTime end) {
  if (end <= begin) return;
  const ImuSpan span = samples_.span(begin, end);
  for (std::size_t i = 1; i < span.knots.size(); ++i) {
    propagate(*state_, span.knots[i - 1], span.knots[i], propagation_);
  }
}

}  // namespace redbee
