#include "processes/imu_integration/node.hpp"

#include <spdlog/spdlog.h>

#include <utility>

#include "processes/conversions.hpp"
#include "processes/note_calibration.hpp"
#include "redbee/configuration/process_table.hpp"
#include "redbee/geometry/time.hpp"
#include "redbee/node/frame_intake.hpp"
#include "redbee/node/work_timer.hpp"

namespace redbee {
namespace {

constexpr int kFrameQueue = 64;
constexpr int kImuQueue = 4000;
constexpr size_t kMaxPendingFrames = 256;
/// Frames in a row that vision must have agreed at before what was learned is worth keeping: a new start
/// would mend what it contradicts, and a process that dies again at once must not leave less than it found.
constexpr int kAgreedFrames = 12;

}  // namespace

ImuIntegrationNode::ImuIntegrationNode(Bus& bus, const Configuration& configuration)
    : bus_(bus),
      configuration_(configuration),
      configuration_hash_(configurationHash(configuration)),
      health_(programName(kImuIntegration), configuration_hash_),
      camera_(configuration.camera),
      filter_(camera_, configuration.inertial),
      feedback_(fromSeconds(configuration.waits.inertial_s).count(), true) {
  const auto damaged = [this] { health_.noteDamaged(); };
  const auto& channels = configuration_.channels;
  bus_.subscribe<image_t>(
      channels.camera, kFrameQueue, [this](const image_t& m) { takeFrame(m); }, damaged);
  bus_.subscribe<ins_t>(
      channels.imu, kImuQueue, [this](const ins_t& m) { takeImu(m); }, damaged);
  if (configuration_.has_altimeter) {
    bus_.subscribe<altimeter_t>(
        channels.altimeter, kImuQueue, [this](const altimeter_t& m) { takeAltitude(m); }, damaged);
  }
  bus_.subscribe<fused_homography_t>(
      channels.fused_homography, kFrameQueue, [this](const fused_homography_t& m) { takeFused(m); }, damaged);
  bus_.subscribe<filter_snapshot_t>(
      channels.warm_start, kFrameQueue, [this](const filter_snapshot_t& m) { takeWarmStart(m); }, damaged);
}

void ImuIntegrationNode::takeFrame(const image_t& message) {
  if (!acceptFrame(order_, health_, message.utime, [this] { restart(); })) return;
  clock_.noteFrame(message.utime);
  pending_.push_back({message.utime, {}});
  if (pending_.size() > kMaxPendingFrames) {
    pending_.pop_front();
    health_.noteSkipped();
  }
}

void ImuIntegrationNode::takeImu(const ins_t& message) {
  clock_.noteOther(message.utime);
  if (!filter_.addImu({ImuTime(fromUtime(message.utime)), vector3(message.gyro), vector3(message.accel)})) {
    health_.noteDamaged();
    return;
  }
  imu_alive_ = true;
}

void ImuIntegrationNode::takeAltitude(const altimeter_t& message) {
  if (!filter_.addAltitude({ImuTime(fromUtime(message.utime)), message.height, message.sigma}))
    health_.noteDamaged();
}

void ImuIntegrationNode::takeFused(const fused_homography_t& message) {
  health_.noteSequence(configuration_.channels.fused_homography, message.sequence);
  if (!plausibleTimes(message)) {
    health_.noteDamaged();
    return;
  }
  feedback_.put(message.utime, message);
}

void ImuIntegrationNode::restart() {
  pending_.clear();
  feedback_.clear();
  filter_ = InertialFilter(camera_, configuration_.inertial);
  clock_.restart();
  last_frame_utime_.reset();
}

bool ImuIntegrationNode::readyFor(int64_t frame_utime) {
  if (finishing_) return true;
  const int64_t patience = fromSeconds(configuration_.waits.inertial_s).count();
  if (imu_alive_ && !filter_.covers(CameraTime(fromUtime(frame_utime)))) {
    if (clock_.now() - frame_utime <= patience) return false;
    imu_alive_ = false;
  }
  if (!last_frame_utime_) return true;
  const int64_t before = feedback_.timedOut();
  const auto answer = feedback_.status(*last_frame_utime_, clock_.now());
  health_.noteLate(feedback_.timedOut() - before);
  return answer != MessageSynchronizer<fused_homography_t>::Status::kPending;
}

void ImuIntegrationNode::warmStart() {
  const std::optional<filter_snapshot_t> kept = std::exchange(kept_, std::nullopt);
  if (!kept || !filter_.isAtFirstFrame()) return;
  if (kept->configuration != configuration_hash_) {
    spdlog::warn("the kept state of {} us is of another configuration: ignored", kept->utime);
    return;
  }
  const SnapshotCheck verdict = filter_.warmStart(snapshotOf(*kept));
  if (verdict == SnapshotCheck::kAccepted) {
    spdlog::info("goes on from the kept state of {} us: {:.2f} m above the ground", kept->utime,
                 kept->height);
  } else {
    spdlog::warn("the kept state of {} us is {}: ignored", kept->utime, toString(verdict));
  }
}

void ImuIntegrationNode::applyFeedback() {
  feedback_report_ = {};
  if (!last_frame_utime_) return;
  const fused_homography_t* fused = feedback_.find(*last_frame_utime_);
  if (fused == nullptr || fused->has_observation == 0) return;
  const HomographyObservation observation{CameraTime(fromUtime(fused->utime_previous)),
                                          CameraTime(fromUtime(fused->utime)), matrix3(fused->H_observed),
                                          matrix8(fused->covariance_observed)};
  if (!observation.H.allFinite() || !observation.covariance.allFinite()) {
    health_.noteDamaged();
    return;
  }
  feedback_report_ = filter_.correct(observation);
  if (!last_H_) return;
  noteCalibration(calibration_, health_, feedback_report_.test_ratio, *last_H_, observation.H,
                  camera_.ideal());
}

void ImuIntegrationNode::publishSnapshot() {
  bus_.publish(configuration_.channels.filter_snapshot, messageOf(*filter_.snapshot(), configuration_hash_));
}

void ImuIntegrationNode::process() {
  while (!pending_.empty() && readyFor(pending_.front().utime)) {
    const Frame frame = pending_.front();
    pending_.pop_front();
    integrate(frame);
  }
}

void ImuIntegrationNode::finish() {
  finishing_ = true;
  process();
  finishing_ = false;
}

void ImuIntegrationNode::integrate(const Frame& frame) {
  FrameTimers timers;
  warmStart();
  applyFeedback();
  agreed_in_a_row_ = feedback_report_.applied ? agreed_in_a_row_ + 1 : 0;
  if (last_frame_utime_) feedback_.eraseThrough(*last_frame_utime_);
  const InertialHomography result = filter_.advanceTo(CameraTime(fromUtime(frame.utime)));
  last_frame_utime_ = frame.utime;
  last_H_ = result.valid ? std::optional<Eigen::Matrix3d>(result.H) : std::nullopt;
  timers.cpu.answered();

  inertial_homography_t message{};
  message.utime = frame.utime;
  message.utime_previous = toUtime(result.time_previous);
  message.sequence = sequence_++;
  message.status = static_cast<int8_t>(result.status);
  message.valid = result.valid ? 1 : 0;
  message.width = camera_.ideal().width;
  message.height = camera_.ideal().height;
  fill(message.H, result.H);
  fill(message.covariance, result.covariance);
  fill(message.R, result.motion.R_ba);
  fill(message.t, result.motion.t_ba);
  fill(message.normal, result.motion.m_a);
  message.plane_distance = result.motion.h_a;
  fill(message.rotation_covariance, result.rotation_covariance);
  fill(message.down, result.direction_of_gravity);
  message.camera_height = result.height_m;
  message.camera_height_sigma = result.height_sigma_m;
  if (const auto state = filter_.state()) {
    fill(message.gyro_bias, state->gyro_bias);
    fill(message.accel_bias, state->accel_bias);
  }
  message.feedback_test_ratio = feedback_report_.test_ratio;
  bus_.publish(configuration_.channels.inertial_homography, message);
  if (result.valid && agreed_in_a_row_ >= kAgreedFrames) publishSnapshot();
  noteDone(health_, frame.utime, frame.since_arrival, timers);
  if (result.valid && result.status == InertialStatus::kGood) {
    health_.setState(HealthState::kGood, "");
  } else {
    health_.setState(HealthState::kDegraded, toString(result.status));
  }
}

}  // namespace redbee
