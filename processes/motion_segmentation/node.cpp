#include "processes/motion_segmentation/node.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <utility>

#include "processes/conversions.hpp"
#include "redbee/bus/image.hpp"
#include "redbee/configuration/process_table.hpp"
#include "redbee/geometry/time.hpp"

namespace redbee {
namespace {

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
    : ImageStage(bus, programName(kMotionSegmentation), configurationHash(configuration),
                 configuration.channels.camera, configuration.waits.max_backlog,
                 {fromSeconds(configuration.waits.segmentation_s), true}),
      configuration_(configuration),
      camera_(configuration.camera, imageDownscale(configuration)),
      foreground_(publisher(), configuration_, camera_),
      segmenter_(configuration.segmentation),
      visual_(Duration(0), false) {
  const auto& channels = configuration_.channels;
  on<fused_homography_t>(channels.fused_homography, [this](const fused_homography_t& m) {
    if (!finiteHomography(m)) return false;
    companions().put(timeOf(m), m);
    return true;
  });
  on<visual_homography_t>(channels.visual_homography, [this](const visual_homography_t& m) {
    if (finiteHomography(m)) visual_.put(timeOf(m), m);
  });
}

void MotionSegmentationNode::reset() {
  visual_.clear();
  last_.reset();
}

SegmentationInput MotionSegmentationNode::inputFor(const image_t& message,
                                                   const fused_homography_t* fused) const {
  SegmentationInput input;
  input.utime = message.utime;
  input.utime_previous = last_ ? last_->utime : message.utime;
  input.K = camera_.camera().K();
  if (!last_) return input;
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
  const visual_homography_t* visual = visual_.find(timeOf(input));
  if (visual == nullptr || visual->status != kVisualGood || visual->utime_previous != last_->utime) return;
  input.ground = matrix3(visual->H);
  input.tracks = tracksOf(*visual);
}

void MotionSegmentationNode::work(const image_t& message) {
  const fused_homography_t* fused = companions().find(timeOf(message));
  SegmentationInput input = inputFor(message, fused);
  decodeInto(input, message);
  const SegmentationOutput output = segmenter_.step(input);
  noteAnswered();
  publishOutput(message, input, output);
  noteState(output.status, fused != nullptr);
  if (fused != nullptr) {
    last_ = Last{message.utime, fused->epoch, fused->utime_anchor, matrix3(fused->H_anchor)};
  } else {
    last_ = Last{message.utime, -1, 0, Eigen::Matrix3d::Identity()};
  }
  companions().eraseThrough(timeOf(message));
  visual_.eraseThrough(timeOf(message));
}

void MotionSegmentationNode::decodeInto(SegmentationInput& input, const image_t& message) {
  const bool wants_colour =
      configuration_.segmentation.method == SegmentationMethod::kParallax && message.pixelformat != kGray;
  const IdealImage image = camera_.ideal(message, wants_colour, health());
  input.size = {camera_.camera().ideal().width, camera_.camera().ideal().height};
  input.grey = image.grey;
  input.colour = image.colour;
  if (!input.grey.empty()) return;
  input.grey = cv::Mat::zeros(input.size, CV_8U);
}

void MotionSegmentationNode::publishOutput(const image_t& message, const SegmentationInput& input,
                                           SegmentationOutput output) {
  for (Detection& detection : output.detections) detection.id = identities_.globalId(detection.id);
  foreground_.publish(message, input.utime_previous, std::move(output));
}

void MotionSegmentationNode::noteState(SegmentationStatus status, bool has_fused) {
  if (status != SegmentationStatus::kGood) {
    health().setState(HealthState::kDegraded, toString(status));
  } else if (!has_fused) {
    health().setState(HealthState::kDegraded, "no fused homography: homography from vision");
  } else {
    health().setState(HealthState::kGood);
  }
}

}  // namespace redbee
