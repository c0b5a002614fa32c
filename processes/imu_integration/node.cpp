#include "processes/imu_integration/node.hpp"

#include <spdlog/spdlog.h>

#include <cmath>
#include <utility>
#include <vector>

#include "processes/conversions.hpp"
#include "processes/lens_messages.hpp"
#include "redbee/configuration/process_table.hpp"
#include "redbee/geometry/time.hpp"

namespace redbee {
namespace {

constexpr size_t kMaxPendingFrames = 256;
/// Time of corrections by vision, of which none was rejected, before a snapshot is published: a state that
/// vision contradicts should not be restored, and a process that crashes immediately must not overwrite the
/// last good snapshot.
constexpr Duration kAgreed = std::chrono::milliseconds(500);
constexpr double kClearOffset_s = 0.1;  // more than two frames' distance

}  // namespace

ImuIntegrationNode::ImuIntegrationNode(Bus& bus, const Configuration& configuration)
    : Stage(bus, programName(kImuIntegration), configurationHash(configuration)),
      configuration_(configuration),
      configuration_hash_(configurationHash(configuration)),
      camera_(configuration.camera),
      filter_(camera_, configuration.inertial),
      feedback_(fromSeconds(configuration.waits.inertial_s), true) {
  const auto& channels = configuration_.channels;
  on<image_t>(channels.camera, [this](const image_t& m) { onFrame(m); });
  // Without it, the process still says what the lens does.
  if (configuration_.has_imu) on<ins_t>(channels.imu, [this](const ins_t& m) { return onImu(m); });
  if (configuration_.has_altimeter) {
    on<altimeter_t>(channels.altimeter, [this](const altimeter_t& m) {
      return filter_.addAltitude({ImuTime(fromUtime(m.utime)), m.height, m.sigma});
    });
  }
  if (configuration_.inertial.gimbal.enabled) {
    on<gimbal_t>(channels.gimbal, [this](const gimbal_t& m) { return onGimbal(m); });
  }
  if (configuration_.inertial.lens.enabled) {
    on<lens_t>(channels.lens, [this](const lens_t& m) { return onLens(m); });
  }
  on<fused_homography_t>(channels.fused_homography, [this](const fused_homography_t& m) { onFused(m); });
  on<filter_snapshot_t>(channels.warm_start, [this](const filter_snapshot_t& m) { warm_start_ = m; });
}

void ImuIntegrationNode::onFrame(const image_t& message) {
  const CameraIntrinsics& camera = configuration_.camera;
  if (!isOfCamera(message, {camera.width, camera.height}, configuration_.channels.camera)) return;
  noteClockOffset(timeOf(message));
  queueFrame(pending_, configuration_.channels.camera, timeOf(message), WorkTimer());
  health().noteSkipped(static_cast<int64_t>(pending_.limitTo(kMaxPendingFrames).size()));
  if (const auto newest = pending_.newest()) clock_.noteFrame(*newest);
}

bool ImuIntegrationNode::onImu(const ins_t& message) {
  const ImuTime time(fromUtime(message.utime));
  clock_.noteOther(time);
  const bool plausible = filter_.addImu({time, vector3(message.gyro), vector3(message.accel)});
  if (filter_.takeForeignSamples() > 0) health().noteIgnored(configuration_.channels.imu, kSecondSource);
  if (plausible) imu_alive_ = true;
  if (plausible) last_sample_ = time;
  return plausible;
}

bool ImuIntegrationNode::onGimbal(const gimbal_t& message) {
  if (message.has_body == 0) return true;
  const double(&q)[4] = message.quat_body;
  const bool is_used = filter_.addMount({ImuTime(fromUtime(message.utime)), {q[0], q[1], q[2], q[3]}});
  gimbal_alive_ = gimbal_alive_ || is_used;
  return is_used;
}

bool ImuIntegrationNode::onLens(const lens_t& message) {
  const auto sample = lensSampleOf(message, configuration_);
  if (!sample) return true;  // of another kind of camera
  const bool is_used = filter_.addLens(*sample);
  lens_alive_ = lens_alive_ || is_used;
  return is_used;
}

void ImuIntegrationNode::noteClockOffset(CameraTime frame) {
  clock_offset_s_.reset();
  if (!last_sample_) return;
  const ImuTime exposure = toImu(frame, fromSeconds(configuration_.inertial.extrinsics.timeshift_s));
  clock_offset_s_ = seconds(exposure - *last_sample_);
  last_sample_.reset();  // an IMU that is silent has no clock
}

std::string ImuIntegrationNode::reasonOf(InertialStatus status) const {
  if (status == InertialStatus::kNoMount) {
    return "no " + configuration_.channels.gimbal +
           " against the body near the frame (gimbal.enabled): vision alone";
  }
  const std::string& disagreement = filter_.agreement().message();
  if (!disagreement.empty()) return disagreement;
  // A smaller one is that of an IMU that has just fallen silent.
  const bool is_clock = clock_offset_s_ && std::abs(*clock_offset_s_) > kClearOffset_s;
  if (status != InertialStatus::kNoImu || !is_clock) return toString(status);
  return disagreementOf(*clock_offset_s_);
}

void ImuIntegrationNode::onFused(const fused_homography_t& message) {
  health().setCalibration(message.calibration);
  feedback_.put(timeOf(message), message, pending_.newest().value_or(CameraTime::min()));
}

void ImuIntegrationNode::restart(CameraTime newest) {
  feedback_.eraseAfter(newest);
  filter_ = InertialFilter(camera_, configuration_.inertial);
  clock_.restart();
  last_frame_.reset();
  agreed_until_.reset();
  earlier_ = {};
}

bool ImuIntegrationNode::isReadyFor(CameraTime frame) {
  if (isFinishing()) return true;
  if (isAwaited(frame, filter_.covers(frame), imu_alive_)) return false;
  if (isAwaited(frame, filter_.coversMount(frame), gimbal_alive_)) return false;
  if (isAwaited(frame, filter_.coversLens(frame), lens_alive_)) return false;
  return !last_frame_ || !isPending(feedback_, *last_frame_);
}

bool ImuIntegrationNode::isAwaited(CameraTime frame, bool is_there, bool& alive) const {
  if (!alive || is_there) return false;
  alive = clock_.now() - frame <= fromSeconds(configuration_.waits.inertial_s);
  return alive;
}

void ImuIntegrationNode::warmStart() {
  const std::optional<filter_snapshot_t> snapshot = std::exchange(warm_start_, std::nullopt);
  if (!snapshot || !filter_.isAtFirstFrame()) return;
  if (snapshot->configuration != configuration_hash_) {
    spdlog::warn("the filter snapshot of {} us is of another configuration: ignored", snapshot->utime);
    return;
  }
  const SnapshotCheck check = filter_.warmStart(snapshotOf(*snapshot));
  if (check == SnapshotCheck::kAccepted) {
    spdlog::info("warm start from the filter snapshot of {} us: {:.2f} m above the ground", snapshot->utime,
                 snapshot->height);
  } else {
    spdlog::warn("the filter snapshot of {} us is {}: ignored", snapshot->utime, toString(check));
  }
}

void ImuIntegrationNode::applyFeedback() {
  feedback_report_ = {};
  if (!last_frame_) return;
  std::vector<HomographyObservation> observations;
  const auto take = [&](const fused_homography_t& fused) {
    if (fused.has_observation == 0) return;
    observations.push_back({previousTimeOf(fused), timeOf(fused), matrix3(fused.observed.H),
                            matrix8(fused.observed.covariance)});
  };
  feedback_.forEach([&](CameraTime time, const fused_homography_t& fused) {
    if (time < *last_frame_) take(fused);  // a late one
  });
  if (const fused_homography_t* fused = feedback_.find(*last_frame_)) take(*fused);
  const std::vector<CorrectionReport> reports = filter_.correct(observations);
  for (size_t i = 0; i < reports.size(); ++i) noteCorrection(observations[i], reports[i]);
}

void ImuIntegrationNode::noteCorrection(const HomographyObservation& observation,
                                        const CorrectionReport& report) {
  if (!report.applied && report.test_ratio == 0) return;  // of frames that the filter does not know
  feedback_report_ = report;
  agreed_ = report.applied ? agreed_ + (observation.time - observation.time_previous) : Duration(0);
  agreed_until_ = observation.time;
}

void ImuIntegrationNode::publishSnapshot() {
  publisher().publishAsIs(configuration_.channels.filter_snapshot,
                          messageOf(*filter_.snapshot(), configuration_hash_));
}

bool ImuIntegrationNode::processNext() {
  return processFront(
      pending_, [this](CameraTime frame) { return isReadyFor(frame); },
      [this](CameraTime frame) { integrate(frame); });
}

void ImuIntegrationNode::integrate(CameraTime frame) {
  warmStart();
  applyFeedback();
  if (!agreed_until_ || frame - *agreed_until_ > kAgreed) agreed_ = Duration(0);
  if (last_frame_) feedback_.eraseThrough(*last_frame_);
  const InertialHomography result = filter_.advanceTo(frame);
  last_frame_ = frame;
  noteResultReady();
  inertial_homography_t message{};
  message.utime_previous = toUtime(result.time_previous);
  message.status = static_cast<int8_t>(result.status);
  message.valid = result.valid ? 1 : 0;
  message.width = camera_.ideal().width;
  message.height = camera_.ideal().height;
  message.zoom = result.zoom.value;
  fill(message.ground, result.H, result.covariance);
  fill(message.motion, result.motion);
  fill(message.rotation_covariance, result.rotation_covariance);
  fill(message.down, result.direction_of_gravity);
  message.camera_height = result.height_m;
  message.camera_height_sigma = result.height_sigma_m;
  if (const auto state = filter_.state()) {
    fill(message.gyro_bias, state->gyro_bias);
    fill(message.accel_bias, state->accel_bias);
  }
  fill(message.row_motion, result.row_motion);
  message.feedback_test_ratio = feedback_report_.test_ratio;
  message.earlier = earlier_;
  publish(configuration_.channels.inertial_homography, message);
  earlier_ = stepOf(message, frame, result.valid);
  if (result.valid && agreed_ >= kAgreed) publishSnapshot();
  updateState(result);
}

void ImuIntegrationNode::updateState(const InertialHomography& result) {
  const bool is_good = result.valid && result.status == InertialStatus::kGood;
  if (configuration_.has_imu && !is_good)
    return health().setState(HealthState::kDegraded, reasonOf(result.status));
  std::string reason = filter_.timeshift().message();
  if (!result.zoom.is_known)
    reason =
        "no " + configuration_.channels.lens + " near the frame (lens.enabled): its focal length is a guess";
  health().setState(reason.empty() ? HealthState::kGood : HealthState::kDegraded, reason);
}

}  // namespace redbee
