#include "inertial/inertial_filter.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <deque>

#include "geometry/chi_square.hpp"
#include "inertial/corrections.hpp"
#include "inertial/error_state.hpp"
#include "inertial/homography_measurement.hpp"
#include "inertial/imu_buffer.hpp"
#include "inertial/imu_sample_check.hpp"
#include "inertial/initial_state.hpp"

namespace redbee {
namespace {

constexpr double kAttitudeWindow =
    0.5;  // s: how much of the accelerometer before the first frame makes the vertical
constexpr double kCoverageTolerance = 0.01;  // s: the newest sample may lie this far before the exposure
constexpr double kMaxOutage = 0.5;           // s without IMU after which attitude is not worth keeping
constexpr double kMemory = 1.0;              // s of samples kept behind the filter, for a restart
constexpr double kMinHeight = 0.05;          // m: a camera cannot be lower
constexpr double kVarianceFloor =
    1e-12;  // scaled units: keeps the homography's covariance invertible at rest

int64_t microseconds(double s) { return static_cast<int64_t>(std::llround(s * 1e6)); }
double seconds(int64_t us) { return static_cast<double>(us) * 1e-6; }

}  // namespace

const char* toString(InertialStatus status) {
  switch (status) {
    case InertialStatus::kGood:
      return "good";
    case InertialStatus::kInitialising:
      return "initialising";
    case InertialStatus::kImuGap:
      return "IMU gap";
    case InertialStatus::kNoImu:
      return "no IMU";
    case InertialStatus::kClockJump:
      return "clock jump";
    case InertialStatus::kBadSamples:
      return "implausible IMU samples refused";
  }
  return "unknown";
}

class InertialFilter::Implementation {
 public:
  Implementation(const Camera& camera, const InertialParameters& parameters)
      : parameters_(parameters),
        propagation_{parameters.noise, parameters.gravity, parameters.max_imu_gap_s},
        camera_(camera),
        K_scaled_(ImageScaling(camera.intrinsics().width, camera.intrinsics().height).T * camera.K()),
        check_(parameters.imu_limits),
        imu_(parameters.max_frame_gap_s),
        altitude_(parameters),
        vision_(parameters) {}

  bool addImu(const ImuSample& sample) {
    if (!isPlausibleTime(sample.utime) || !sample.gyro.allFinite() || !sample.accel.allFinite()) return false;
    for (const ImuSample& believed : check_.take(sample)) imu_.add(believed);
    return true;
  }

  bool addAltitude(const AltitudeSample& sample) {
    const bool usable = isPlausibleTime(sample.utime) && std::isfinite(sample.height_m) &&
                        std::isfinite(sample.sigma_m) && sample.sigma_m > 0;
    if (usable) altitude_.add(sample);
    return usable;
  }

  bool covers(int64_t frame) const {
    return isPlausibleTime(frame) && !imu_.empty() && imu_.newest() >= imuTime(frame);
  }

  InertialHomography advanceTo(int64_t frame) {
    if (!isPlausibleTime(frame) || (frame_ && frame == *frame_)) {
      return nothing(frame, InertialStatus::kClockJump);
    }
    if (!frame_) return start(frame, InertialStatus::kInitialising);
    const double interval = seconds(frame - *frame_);
    if (interval < 0 || interval > parameters_.max_frame_gap_s) {
      return start(frame, InertialStatus::kClockJump);
    }
    if (imu_.empty()) return coast(frame);
    const ImuSpan span = imu_.span(imuTime(*frame_), imuTime(frame));
    if (span.measured == 0 && std::max(span.longest_hole_s, span.extrapolated_s) > kCoverageTolerance) {
      return coast(frame);
    }
    return move(frame, span);
  }

  CorrectionReport correct(const HomographyObservation& observation) {
    const bool belongs = state_ && previous_frame_ && !corrected_ && observation.utime == *frame_ &&
                         observation.utime_previous == *previous_frame_;
    if (!belongs) return {};
    const NavigationState before = *state_;
    const CorrectionReport report =
        vision_.correct(*state_, observation, camera_, parameters_.extrinsics.p_IC);
    corrected_ = report.applied;
    keepAboveGround();
    if (!isSound(*state_)) {
      state_ = before;
      return {};
    }
    return report;
  }

  std::optional<InertialState> state() const {
    if (!state_) return std::nullopt;
    return InertialState{*frame_,           state_->R_GI,
                         state_->v_GI,      cameraHeight(*state_, parameters_.extrinsics.p_IC),
                         state_->gyro_bias, state_->accel_bias,
                         state_->R_CI};
  }

 private:
  int64_t imuTime(int64_t frame) const { return frame + microseconds(parameters_.extrinsics.timeshift_s); }

  InertialHomography nothing(int64_t frame, InertialStatus status) const {
    InertialHomography result;
    result.utime_previous = frame_.value_or(frame);
    result.utime = frame;
    result.status = status;
    result.motion = {Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ(), 1.0};
    return result;
  }

  InertialHomography start(int64_t frame, InertialStatus status) {
    const InertialHomography result = nothing(frame, status);
    const int64_t time = imuTime(frame);
    const std::vector<ImuSample> before = attitudeSamples(time);
    forgetFrames();
    if (before.empty()) {
      state_.reset();
      return nothing(frame, status == InertialStatus::kClockJump ? status : InertialStatus::kNoImu);
    }
    state_ = sensors_ ? restartedState(*sensors_, before, parameters_) : initialState(before, parameters_);
    frame_ = frame;
    sensors_ = state_;
    altitude_.forgetBefore(time);
    vision_.restart();
    return result;
  }

  std::vector<ImuSample> attitudeSamples(int64_t time) const {
    if (imu_.empty()) return {};
    std::vector<ImuSample> samples = imu_.samplesOn(time - microseconds(kAttitudeWindow), time);
    if (!samples.empty()) return samples;
    samples = imu_.samplesOn(time, time + microseconds(parameters_.max_imu_gap_s));
    if (samples.size() > 1) samples.resize(1);
    return samples;
  }

  void forgetFrames() {
    frame_.reset();
    previous_frame_.reset();
    corrected_ = false;
  }

  /// No sample in the interval: the state is carried over on the last one for a while, and given up after.
  InertialHomography coast(int64_t frame) {
    const InertialHomography result = nothing(frame, statusOf(frame, InertialStatus::kNoImu));
    if (outageAt(imuTime(frame)) > kMaxOutage) {
      forgetFrames();
      state_.reset();
      return result;
    }
    integrate(frame);
    return isSound(*state_) ? result : startAfresh(frame);
  }

  /// s, to the nearest sample, which lies ahead where the IMU's clock has jumped.
  double outageAt(int64_t time) const {
    if (imu_.empty()) return kMaxOutage + 1;
    return seconds(std::max(time - imu_.newest(), imu_.oldest() - time));
  }

  InertialHomography move(int64_t frame, const ImuSpan& span) {
    const bool gap =
        span.longest_hole_s > parameters_.max_imu_gap_s || span.extrapolated_s > kCoverageTolerance;
    InertialHomography result =
        nothing(frame, statusOf(frame, gap ? InertialStatus::kImuGap : InertialStatus::kGood));
    correctByGravity(*state_, span, parameters_, vision_.secondsSinceApplied(*frame_));
    integrate(frame);
    if (!isSound(*state_)) return startAfresh(frame);
    describe(result);
    if (!result.H.allFinite() || !result.covariance.allFinite()) return startAfresh(frame);
    result.valid = true;
    sensors_ = state_;
    return result;
  }

  /// Refused samples explain what is missing.
  InertialStatus statusOf(int64_t frame, InertialStatus otherwise) const {
    const bool refused = check_.refusedOn(imuTime(*frame_), imuTime(frame)) > 0;
    return refused ? InertialStatus::kBadSamples : otherwise;
  }

  InertialHomography startAfresh(int64_t frame) {
    sensors_.reset();
    return start(frame, InertialStatus::kInitialising);
  }

  /// Moves the state to the frame, stopping at each altitude on the way.
  void integrate(int64_t frame) {
    int64_t time = imuTime(*frame_);
    const int64_t end = imuTime(frame);
    altitude_.correctLate(*state_, time);
    clonePose(*state_);
    while (const std::optional<AltitudeSample> altitude = altitude_.next(end)) {
      integrateTo(time, altitude->utime);
      time = altitude->utime;
      altitude_.correct(*state_, *altitude, 0);
    }
    integrateTo(time, end);
    keepAboveGround();
    imu_.forgetBefore(end - microseconds(kMemory));
    check_.forgetBefore(end - microseconds(kMemory));
    previous_frame_ = frame_;
    frame_ = frame;
    corrected_ = false;
  }

  void integrateTo(int64_t begin, int64_t end) {
    if (end <= begin) return;
    const ImuSpan span = imu_.span(begin, end);
    for (std::size_t i = 1; i < span.knots.size(); ++i) {
      propagate(*state_, span.knots[i - 1], span.knots[i], propagation_);
    }
  }

  void keepAboveGround() {
    const double missing = kMinHeight - cameraHeight(*state_, parameters_.extrinsics.p_IC);
    if (missing <= 0) return;
    state_->p_GI.z() += missing;
    state_->p_GI_clone.z() += missing;
  }

  void describe(InertialHomography& result) const {
    const Eigen::Vector3d& p_IC = parameters_.extrinsics.p_IC;
    result.motion = cameraMotion(*state_, p_IC);
    result.H = planeHomography(camera_.K(), result.motion);
    const MotionJacobians J = motionJacobians(*state_, result.motion, p_IC);
    const HomographyMeasurement z = homographyMeasurement(*state_, result.motion, J, K_scaled_);
    const Matrix8d covariance =
        z.linear_covariance + z.second_order_covariance + kVarianceFloor * Matrix8d::Identity();
    result.covariance = 0.5 * (covariance + covariance.transpose());
    result.rotation_covariance = J.rotation * state_->P * J.rotation.transpose();
    result.direction_of_gravity = -(state_->R_CI * state_->R_GI.transpose()).col(2);
    result.height_m = cameraHeight(*state_, p_IC);
    const MeasurementJacobian<1> J_height = cameraHeightJacobian(*state_, p_IC);
    result.height_sigma_m = std::sqrt((J_height * state_->P * J_height.transpose()).value());
  }

  InertialParameters parameters_;
  PropagationParameters propagation_;
  Camera camera_;
  Eigen::Matrix3d K_scaled_;
  ImuSampleCheck check_;
  ImuBuffer imu_;
  AltitudeCorrection altitude_;
  VisionCorrection vision_;
  std::optional<NavigationState> state_;
  std::optional<NavigationState> sensors_;  ///< the last sound state: biases and mounting outlive a restart
  std::optional<int64_t> frame_;
  std::optional<int64_t> previous_frame_;
  bool corrected_ = false;  ///< by vision, for the last two frames
};

InertialFilter::InertialFilter(const Camera& camera, const InertialParameters& parameters)
    : implementation_(std::make_unique<Implementation>(camera, parameters)) {}
InertialFilter::~InertialFilter() = default;
InertialFilter::InertialFilter(InertialFilter&&) noexcept = default;
InertialFilter& InertialFilter::operator=(InertialFilter&&) noexcept = default;

bool InertialFilter::addImu(const ImuSample& sample) { return implementation_->addImu(sample); }
bool InertialFilter::addAltitude(const AltitudeSample& sample) {
  return implementation_->addAltitude(sample);
}
bool InertialFilter::covers(int64_t frame_utime) const { return implementation_->covers(frame_utime); }
InertialHomography InertialFilter::advanceTo(int64_t frame_utime) {
  return implementation_->advanceTo(frame_utime);
}
CorrectionReport InertialFilter::correct(const HomographyObservation& observation) {
  return implementation_->correct(observation);
}
std::optional<InertialState> InertialFilter::state() const { return implementation_->state(); }

}  // namespace redbee
