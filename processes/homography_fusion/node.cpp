#include "processes/homography_fusion/node.hpp"

#include "processes/conversions.hpp"
#include "processes/note_calibration.hpp"
#include "redbee/configuration/process_table.hpp"
#include "redbee/geometry/time.hpp"
#include "redbee/inertial/inertial_homography.hpp"
#include "redbee/ins_t.hpp"
#include "redbee/node/work_timer.hpp"
#include "redbee/visual/homography_estimation.hpp"

namespace redbee {
namespace {

constexpr int kQueue = 64;
constexpr int kImuQueue = 4000;
constexpr size_t kMaxPending = 64;
constexpr int8_t kVisualGood = 0;
constexpr auto kInertialInitialising = static_cast<int8_t>(InertialStatus::kInitialising);

VisualInput inputOf(const visual_homography_t& visual) {
  return {CameraTime(fromUtime(visual.utime_previous)), matrix3(visual.H), matrix8(visual.covariance),
          visual.inliers, visual.outliers};
}

}  // namespace

HomographyFusionNode::HomographyFusionNode(Bus& bus, const Configuration& configuration)
    : bus_(bus),
      configuration_(configuration),
      health_(programName(kHomographyFusion), configurationHash(configuration)),
      camera_(idealCamera(configuration.camera)),
      fusion_(camera_.width, camera_.height, configuration.fusion),
      inertial_(fromSeconds(configuration.waits.fusion_s).count(), configuration.has_imu),
      visual_(fromSeconds(configuration.waits.fusion_s).count(), true) {
  const auto damaged = [this] { health_.noteDamaged(); };
  const auto& channels = configuration_.channels;
  bus_.subscribe<inertial_homography_t>(
      channels.inertial_homography, kQueue, [this](const inertial_homography_t& m) { takeInertial(m); },
      damaged);
  bus_.subscribe<filter_snapshot_t>(
      channels.filter_snapshot, kQueue, [this](const filter_snapshot_t& m) { takeState(m); }, damaged);
  bus_.subscribe<visual_homography_t>(
      channels.visual_homography, kQueue, [this](const visual_homography_t& m) { takeVisual(m); }, damaged);
  if (configuration_.has_imu) {
    bus_.subscribe<ins_t>(
        channels.imu, kImuQueue, [this](const ins_t& m) { clock_.noteOther(m.utime); }, damaged);
  }
}

void HomographyFusionNode::takeInertial(const inertial_homography_t& message) {
  health_.noteSequence(configuration_.channels.inertial_homography, message.sequence);
  if (!plausibleTimes(message) || (!finiteHomography(message) && message.valid != 0)) {
    health_.noteDamaged();
    return;
  }
  if (message.valid == 0 && message.status == kInertialInitialising) inertial_at_first_frame_ = true;
  expect(message.utime);
  inertial_.put(message.utime, message);
}

void HomographyFusionNode::takeVisual(const visual_homography_t& message) {
  health_.noteSequence(configuration_.channels.visual_homography, message.sequence);
  if (!plausibleTimes(message) || (!finiteHomography(message) && message.status == kVisualGood)) {
    health_.noteDamaged();
    return;
  }
  expect(message.utime);
  visual_.put(message.utime, message);
}

void HomographyFusionNode::expect(int64_t utime) {
  if (pending_.count(utime) > 0) return;
  const bool is_companion_of_last = order_.last() == utime;
  if (is_companion_of_last) return;  // came after its frame was given up
  const int64_t newest_frame = pending_.empty() ? order_.last().value_or(utime) : pending_.rbegin()->first;
  if (newest_frame - utime > FrameOrder::kSetBack) restart();
  clock_.noteFrame(utime);
  health_.noteInput(utime);
  pending_.emplace(utime, WorkTimer());
  if (pending_.size() > kMaxPending) {
    pending_.erase(pending_.begin());
    health_.noteSkipped();
  }
}

void HomographyFusionNode::restart() {
  pending_.clear();
  inertial_.clear();
  visual_.clear();
  kept_.reset();
  clock_.restart();
}

void HomographyFusionNode::publishWarmStart() {
  if (inertial_at_first_frame_ && kept_) bus_.publish(configuration_.channels.warm_start, *kept_);
  inertial_at_first_frame_ = false;
}

bool HomographyFusionNode::ready(int64_t utime) {
  if (finishing_) return true;
  const int64_t before = inertial_.timedOut() + visual_.timedOut();
  const auto inertial = inertial_.status(utime, clock_.now());
  const auto visual = visual_.status(utime, clock_.now());
  health_.noteLate(inertial_.timedOut() + visual_.timedOut() - before);
  return inertial != MessageSynchronizer<inertial_homography_t>::Status::kPending &&
         visual != MessageSynchronizer<visual_homography_t>::Status::kPending;
}

void HomographyFusionNode::process() {
  publishWarmStart();  // before its first frame is answered, which it waits for
  while (!pending_.empty() && ready(pending_.begin()->first)) {
    const auto [utime, since_arrival] = *pending_.begin();
    pending_.erase(pending_.begin());
    const auto verdict = order_.classify(utime);
    if (verdict == FrameDecision::kDiscard) {
      health_.noteSkipped();
      continue;
    }
    if (verdict == FrameDecision::kRestart) {
      fusion_ = HomographyFusion(camera_.width, camera_.height, configuration_.fusion);
    }
    fuse(utime, since_arrival);
  }
}

void HomographyFusionNode::finish() {
  finishing_ = true;
  process();
  finishing_ = false;
}

void HomographyFusionNode::fuse(int64_t utime, const WorkTimer& since_arrival) {
  FrameTimers timers;
  const inertial_homography_t* inertial = inertial_.find(utime);
  const visual_homography_t* visual = visual_.find(utime);
  std::optional<InertialInput> inertial_input;
  if (inertial != nullptr && inertial->valid != 0) {
    inertial_input = InertialInput{CameraTime(fromUtime(inertial->utime_previous)), matrix3(inertial->H),
                                   matrix8(inertial->covariance)};
  }
  std::optional<VisualInput> visual_input;
  if (visual != nullptr && visual->status == kVisualGood) visual_input = inputOf(*visual);
  const FusedHomography fused = fusion_.step(CameraTime(fromUtime(utime)), inertial_input, visual_input);
  if (fused.has_innovation && inertial_input && visual_input &&
      inertial_input->time_previous == visual_input->time_previous) {
    noteCalibration(calibration_, health_, fused.test_ratio, inertial_input->H, visual_input->H, camera_);
  }
  fused_homography_t message = messageOf(fused);
  addSources(message, fused, inertial, visual);
  timers.cpu.answered();
  bus_.publish(configuration_.channels.fused_homography, message);
  inertial_.eraseThrough(utime);
  visual_.eraseThrough(utime);
  noteDone(health_, utime, since_arrival, timers);
  const bool good = fused.source == FusionSource::kFused ||
                    (!configuration_.has_imu && fused.source == FusionSource::kVisual);
  health_.setState(good ? HealthState::kGood : HealthState::kDegraded,
                   good ? "" : std::string("homography from: ") + toString(fused.source));
}

fused_homography_t HomographyFusionNode::messageOf(const FusedHomography& fused) {
  fused_homography_t message{};
  message.utime = toUtime(fused.time);
  message.utime_previous = toUtime(fused.time_previous);
  message.sequence = sequence_++;
  message.source = static_cast<int8_t>(fused.source);
  message.epoch = fused.epoch;
  message.utime_anchor = toUtime(fused.time_anchor);
  message.width = camera_.width;
  message.height = camera_.height;
  fill(message.H, fused.H_step);
  fill(message.covariance, fused.covariance_step);
  fill(message.H_anchor, fused.H_anchor);
  fill(message.covariance_anchor, fused.covariance_anchor);
  message.has_innovation = fused.has_innovation ? 1 : 0;
  if (fused.has_innovation) {
    fill(message.innovation, fused.innovation);
    fill(message.innovation_covariance, fused.innovation_covariance);
    message.test_ratio = fused.test_ratio;
  }
  return message;
}

void HomographyFusionNode::addSources(fused_homography_t& message, const FusedHomography& fused,
                                      const inertial_homography_t* inertial,
                                      const visual_homography_t* visual) const {
  if (inertial != nullptr && inertial->valid != 0 && inertial->utime_previous == message.utime_previous) {
    message.has_motion = 1;
    fill(message.R, matrix3(inertial->R));
    fill(message.t, vector3(inertial->t));
    fill(message.normal, vector3(inertial->normal));
    message.plane_distance = inertial->plane_distance;
  }
  if (visual != nullptr && visual->utime_previous == message.utime_previous) {
    const PointTracks tracks = tracksOf(*visual);
    fillTracks(message, tracks);
    if (visual->status == kVisualGood) {
      // Refused or not: the inertial filter judges for itself, or a filter gone wrong would never be told.
      message.has_observation = 1;
      fill(message.H_observed, matrix3(visual->H));
      fill(message.covariance_observed, measurementCovariance(inputOf(*visual), configuration_.fusion));
    }
    if (fused.source != FusionSource::kNone) {
      const auto front =
          estimateFrontPlane(tracks, fused.H_step, message.width, message.height, configuration_.front);
      if (front) {
        message.has_front = 1;
        fill(message.H_front, front->H);
        message.front_inliers = front->inliers;
      }
    }
  }
}

}  // namespace redbee
