#include "processes/motion_segmentation/node.hpp"

#include <Eigen/LU>
#include <algorithm>

#include "processes/conversions.hpp"
#include "processes/note_calibration.hpp"
#include "redbee/bus/image.hpp"
#include "redbee/configuration/process_table.hpp"
#include "redbee/geometry/time.hpp"
#include "redbee/node/work_timer.hpp"

namespace redbee {
namespace {

constexpr int kFrameQueue = 64;
constexpr int8_t kVisualGood = 0;

/// How much smaller a image may be decoded: the parallax segmentation shrinks it anyway.
int imageDownscale(const Configuration& configuration) {
  const SegmentationParameters& segmentation = configuration.segmentation;
  if (segmentation.method != SegmentationMethod::kParallax) return 1;
  int downscale = segmentation.work_downscale;
  if (segmentation.use_appearance) downscale = std::min(downscale, segmentation.background_downscale);
  const auto divides = [downscale](const CameraIntrinsics& camera) {
    return camera.width % downscale == 0 && camera.height % downscale == 0;
  };
  return divides(configuration.camera) && divides(idealCamera(configuration.camera)) ? downscale : 1;
}

}  // namespace

MotionSegmentationNode::MotionSegmentationNode(Bus& bus, const Configuration& configuration)
    : bus_(bus),
      configuration_(configuration),
      health_(programName(kMotionSegmentation), configurationHash(configuration)),
      camera_(configuration.camera, imageDownscale(configuration)),
      publisher_(bus_, configuration_, camera_),
      segmenter_(configuration.segmentation),
      images_(configuration.waits.max_backlog),
      fused_(fromSeconds(configuration.waits.segmentation_s).count(), true),
      visual_(0, false) {
  const auto damaged = [this] { health_.noteDamaged(); };
  const auto& channels = configuration_.channels;
  bus_.subscribe<image_t>(
      channels.camera, kFrameQueue,
      [this](const image_t& m) { images_.take(m, health_, [this] { restart(); }); }, damaged);
  bus_.subscribe<fused_homography_t>(
      channels.fused_homography, kFrameQueue,
      [this](const fused_homography_t& m) {
        health_.noteSequence(configuration_.channels.fused_homography, m.sequence);
        if (finiteHomography(m)) {
          fused_.put(m.utime, m);
          judgeCalibration(m);
        } else {
          health_.noteDamaged();
        }
      },
      damaged);
  bus_.subscribe<visual_homography_t>(
      channels.visual_homography, kFrameQueue,
      [this](const visual_homography_t& m) {
        if (finiteHomography(m)) visual_.put(m.utime, m);
      },
      damaged);
}

void MotionSegmentationNode::judgeCalibration(const fused_homography_t& fused) {
  if (fused.has_innovation == 0 || fused.has_motion == 0 || fused.has_observation == 0) return;
  const PlaneMotion motion{matrix3(fused.R), vector3(fused.t), vector3(fused.normal), fused.plane_distance};
  noteCalibration(calibration_, health_, fused.test_ratio, planeHomography(camera_.camera().K(), motion),
                  matrix3(fused.H_observed), camera_.camera().ideal());
}

void MotionSegmentationNode::restart() {
  fused_.clear();
  visual_.clear();
  last_.reset();
}

void MotionSegmentationNode::process() {
  images_.workOff(fused_, health_, [this](const Arrived<image_t>& frame) { segment(frame); });
}

void MotionSegmentationNode::finish() {
  images_.workOffAll([this](const Arrived<image_t>& frame) { segment(frame); });
}

SegmentationInput MotionSegmentationNode::inputFor(const image_t& message) const {
  SegmentationInput input;
  input.utime = message.utime;
  input.utime_previous = last_ ? last_->utime : message.utime;
  input.K = camera_.camera().K();
  if (!last_) return input;
  const fused_homography_t* fused = fused_.find(message.utime);
  if (fused == nullptr || fused->source == 0) {
    addVisual(input);
    return input;
  }
  if (fused->utime_previous == last_->utime) {
    input.ground = matrix3(fused->H);
    input.tracks = tracksOf(*fused);
    if (fused->has_front != 0) input.front = matrix3(fused->H_front);
    if (fused->has_motion != 0) {
      input.motion =
          PlaneMotion{matrix3(fused->R), vector3(fused->t), vector3(fused->normal), fused->plane_distance};
    }
  } else if (fused->epoch == last_->epoch && fused->utime_anchor == last_->utime_anchor) {
    // A frame between was missed: the anchor homographies bridge it (libs/README.md, equation 25). A
    // restarted fusion counts its epochs from 0 again, so the anchor's time is compared as well.
    input.ground = normaliseHomography(matrix3(fused->H_anchor) * last_->H_anchor.inverse());
  }
  return input;
}

/// While the fusion is away or knows nothing yet (its process was started again): vision's own homography
/// keeps background and identities.
void MotionSegmentationNode::addVisual(SegmentationInput& input) const {
  const visual_homography_t* visual = visual_.find(input.utime);
  if (visual == nullptr || visual->status != kVisualGood || visual->utime_previous != last_->utime) return;
  input.ground = matrix3(visual->H);
  input.tracks = tracksOf(*visual);
}

void MotionSegmentationNode::segment(const Arrived<image_t>& frame) {
  FrameTimers timers;
  const image_t& message = frame.content;
  SegmentationInput input = inputFor(message);
  decodeInto(input, message);
  const SegmentationOutput output = segmenter_.step(input);
  timers.cpu.answered();
  publish(message, input, output);
  if (const fused_homography_t* fused = fused_.find(message.utime)) {
    last_ = Last{message.utime, fused->epoch, fused->utime_anchor, matrix3(fused->H_anchor)};
  } else {
    last_ = Last{message.utime, -1, 0, Eigen::Matrix3d::Identity()};
  }
  fused_.eraseThrough(message.utime);
  visual_.eraseThrough(message.utime);
  noteDone(health_, message.utime, frame.since, timers);
}

void MotionSegmentationNode::decodeInto(SegmentationInput& input, const image_t& message) {
  const bool wants_colour =
      configuration_.segmentation.method == SegmentationMethod::kParallax && message.pixelformat != kGray;
  const IdealImage image = camera_.ideal(message, wants_colour, health_);
  input.size = {camera_.camera().ideal().width, camera_.camera().ideal().height};
  input.grey = image.grey;
  input.colour = image.colour;
  if (!input.grey.empty()) return;
  input.grey = cv::Mat::zeros(input.size, CV_8U);
}

void MotionSegmentationNode::publish(const image_t& message, const SegmentationInput& input,
                                     SegmentationOutput output) {
  for (Detection& detection : output.detections) detection.id = identities_.globalId(detection.id);
  publisher_.publish(message, input.utime_previous, output);
  if (output.status != SegmentationStatus::kGood) {
    health_.setState(HealthState::kDegraded, toString(output.status));
  } else if (fused_.find(output.utime) == nullptr) {
    health_.setState(HealthState::kDegraded, "the fusion is away: homography from vision");
  } else {
    health_.setState(HealthState::kGood);
  }
}

}  // namespace redbee
