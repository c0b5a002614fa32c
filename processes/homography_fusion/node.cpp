#include "processes/homography_fusion/node.hpp"

#include "processes/conversions.hpp"
#include "redbee/configuration/process_table.hpp"
#include "redbee/geometry/homography.hpp"
#include "redbee/geometry/time.hpp"
#include "redbee/inertial/inertial_homography.hpp"
#include "redbee/ins_t.hpp"

namespace redbee {
namespace {

constexpr size_t kMaxPending = 64;

VisualInput inputOf(const visual_homography_t& visual) {
  return {previousTimeOf(visual), matrix3(visual.ground.H), matrix8(visual.ground.covariance), visual.inliers,
          visual.outliers};
}

}  // namespace

HomographyFusionNode::HomographyFusionNode(Bus& bus, const Configuration& configuration)
    : Stage(bus, programName(kHomographyFusion), configurationHash(configuration)),
      configuration_(configuration),
      camera_(idealCamera(configuration.camera)),
      fusion_(camera_.width, camera_.height, configuration.fusion),
      front_plane_(camera_.width, camera_.height, configuration.front),
      inertial_(fromSeconds(configuration.waits.fusion_s), configuration.expectsInertial()),
      visual_(fromSeconds(configuration.waits.fusion_s), true) {
  const auto& channels = configuration_.channels;
  on<inertial_homography_t>(channels.inertial_homography,
                            [this](const inertial_homography_t& m) { onInertial(m); });
  on<filter_snapshot_t>(channels.filter_snapshot, [this](const filter_snapshot_t& m) { snapshot_ = m; });
  on<visual_homography_t>(channels.visual_homography, [this](const visual_homography_t& m) { onVisual(m); });
  if (configuration_.has_imu) {
    on<ins_t>(channels.imu, [this](const ins_t& m) { clock_.noteOther(ImuTime(fromUtime(m.utime))); });
  }
}

void HomographyFusionNode::onInertial(const inertial_homography_t& message) {
  if (message.valid == 0 && message.status == inertial_homography_t::INITIALISING) {
    inertial_at_first_frame_ = true;
  }
  queue(configuration_.channels.inertial_homography, message, restoredInertial(message), inertial_);
}

void HomographyFusionNode::onVisual(const visual_homography_t& message) {
  queue(configuration_.channels.visual_homography, message, restoredVisual(message), visual_);
}

template <typename Message>
void HomographyFusionNode::queue(const std::string& channel, const Message& message,
                                 const std::optional<Message>& restored,
                                 MessageSynchronizer<Message>& messages) {
  if (restored && isStillToCome(timeOf(*restored))) {
    expect(channel, timeOf(*restored));
    messages.putRestored(timeOf(*restored), *restored);
  }
  expect(channel, timeOf(message));
  messages.put(timeOf(message), message, newestFrame());
}

void HomographyFusionNode::expect(const std::string& channel, CameraTime time) {
  queueFrame(pending_, channel, time, WorkTimer());
  health().noteSkipped(static_cast<int64_t>(pending_.limitTo(kMaxPending).size()));
  if (const auto newest = pending_.newest()) clock_.noteFrame(*newest);
}

void HomographyFusionNode::restart(CameraTime newest) {
  inertial_.eraseAfter(newest);
  visual_.eraseAfter(newest);
  snapshot_.reset();
  clock_.restart();
  fusion_ = HomographyFusion(camera_.width, camera_.height, configuration_.fusion);
}

void HomographyFusionNode::publishWarmStart() {
  if (inertial_at_first_frame_ && snapshot_) {
    publisher().publishAsIs(configuration_.channels.warm_start, *snapshot_);
  }
  inertial_at_first_frame_ = false;
}

bool HomographyFusionNode::isReadyFor(CameraTime time) {
  const bool waits_for_inertial = isPending(inertial_, time);
  const bool waits_for_visual = isPending(visual_, time);
  return !waits_for_inertial && !waits_for_visual;
}

bool HomographyFusionNode::processNext() {
  publishWarmStart();  // before the fused message of its first frame, which it waits for
  return processFront(
      pending_, [this](CameraTime frame) { return isReadyFor(frame); },
      [this](CameraTime frame) { fuse(frame); });
}

void HomographyFusionNode::fuse(CameraTime time) {
  const inertial_homography_t* inertial = inertial_.find(time);
  const visual_homography_t* visual = visual_.find(time);
  std::optional<InertialInput> inertial_input;
  if (inertial != nullptr && inertial->valid != 0) {
    inertial_input = InertialInput{previousTimeOf(*inertial), matrix3(inertial->ground.H),
                                   matrix8(inertial->ground.covariance)};
  }
  std::optional<VisualInput> visual_input;
  if (visual != nullptr && visual->status == visual_homography_t::GOOD) visual_input = inputOf(*visual);
  if (inertial != nullptr) {
    calibration_.setDisagreement(inertial->status == inertial_homography_t::VISION_DISAGREES);
  }
  const bool is_skipped = visual != nullptr && visual->status == visual_homography_t::SKIPPED;
  if (is_skipped && !inertial_input) return leaveOut(time, *visual);
  const FusedHomography fused = fusion_.step(time, inertial_input, visual_input);
  if (fused.has_innovation && inertial_input && visual_input) {
    validateCalibration(fused, *inertial_input, *visual_input);
  }
  if (inertial != nullptr) health().setCalibration(calibration_.status());
  fused_homography_t message = messageOf(fused);
  if (inertial != nullptr) message.row_motion = inertial->row_motion;
  message.zoom = inertial != nullptr ? inertial->zoom : visual != nullptr ? visual->zoom : 0;
  if (visual != nullptr) addTracked(message, *visual, fused);
  const bool has_motion = inertial_input && inertial->motion.distance > 0;  // a restored message has none
  if (has_motion && inertial_input->time_previous == fused.time_previous) {
    message.has_motion = 1;
    message.motion = inertial->motion;
  }
  // Whether the fusion rejected it or not: the inertial filter has its own gate, and a diverged filter could
  // otherwise never be corrected.
  if (fused.visual_step) {
    message.has_observation = 1;
    fill(message.observed, fused.visual_step->H, fused.visual_step->covariance);
  }
  publishAndForget(time, message);
  const bool good = fused.source == FusionSource::kFused ||
                    (!configuration_.has_imu && fused.source == FusionSource::kVisual);
  health().setState(good ? HealthState::kGood : HealthState::kDegraded,
                    good ? "" : std::string("homography from: ") + toString(fused.source));
}

void HomographyFusionNode::leaveOut(CameraTime time, const visual_homography_t& visual) {
  FusedHomography none;
  none.time_previous = previousTimeOf(visual);
  none.time_anchor = none.time_previous;
  none.H_step = none.H_anchor = Eigen::Matrix3d::Identity();
  none.covariance_step = none.covariance_anchor = Matrix8d::Zero();
  fused_homography_t message = messageOf(none);
  message.zoom = visual.zoom;
  publishAndForget(time, message);
}

void HomographyFusionNode::publishAndForget(CameraTime time, const fused_homography_t& message) {
  noteResultReady();
  publish(configuration_.channels.fused_homography, message);
  inertial_.eraseThrough(time);
  visual_.eraseThrough(time);
}

void HomographyFusionNode::validateCalibration(const FusedHomography& fused, const InertialInput& inertial,
                                               const VisualInput& visual) {
  if (inertial.time_previous != visual.time_previous) return;
  calibration_.note(fused.test_ratio, meanTransferError(inertial.H, visual.H, camera_.width, camera_.height));
}

fused_homography_t HomographyFusionNode::messageOf(const FusedHomography& fused) const {
  fused_homography_t message{};
  message.utime_previous = toUtime(fused.time_previous);
  message.source = static_cast<int8_t>(fused.source);
  message.epoch = fused.epoch;
  message.utime_anchor = toUtime(fused.time_anchor);
  message.width = camera_.width;
  message.height = camera_.height;
  message.utime_tracks = message.utime_previous;
  message.calibration = calibration_.status();
  fill(message.step, fused.H_step, fused.covariance_step);
  fill(message.anchor, fused.H_anchor, fused.covariance_anchor);
  message.has_innovation = fused.has_innovation ? 1 : 0;
  if (fused.has_innovation) {
    fill(message.innovation, fused.innovation);
    fill(message.innovation_covariance, fused.innovation_covariance);
    message.test_ratio = fused.test_ratio;
  }
  return message;
}

void HomographyFusionNode::addTracked(fused_homography_t& message, const visual_homography_t& visual,
                                      const FusedHomography& fused) {
  const CameraTime from = previousTimeOf(visual);
  const bool is_step = from == fused.time_previous;
  const std::optional<Eigen::Matrix3d> ground = is_step ? fused.H_step : fusion_.since(from);
  if (!ground) return;
  const PointTracks tracks = tracksOf(visual.tracks);
  message.utime_tracks = visual.utime_previous;
  fill(message.tracks, tracks);
  if (fused.source == FusionSource::kNone) return;
  const std::optional<HomographyEstimate> front = front_plane_.estimate(tracks, *ground);
  if (!front) return;
  message.has_front = 1;
  fill(message.H_front, front->H);
  message.front_inliers = front->inliers;
}

}  // namespace redbee
