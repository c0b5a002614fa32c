#include "processes/motion_segmentation/node.hpp"

#include <spdlog/spdlog.h>

#include <Eigen/LU>
#include <algorithm>
#include <chrono>
#include <opencv2/imgproc.hpp>
#include <set>
#include <utility>

#include "processes/conversions.hpp"
#include "processes/motion_segmentation/frame_step.hpp"
#include "redbee/bus/image.hpp"
#include "redbee/configuration/process_table.hpp"
#include "redbee/geometry/time.hpp"

namespace redbee {
namespace {

/// Messages about earlier frames are kept for this long.
constexpr Duration kLinking = std::chrono::milliseconds(500);

/// How much smaller an image may be decoded.
int imageDownscale(const DetectorNeeds& needs, const CameraIntrinsics& camera) {
  const auto divides = [&](const CameraIntrinsics& of) {
    return of.width % needs.image_downscale == 0 && of.height % needs.image_downscale == 0;
  };
  return divides(camera) && divides(idealCamera(camera)) ? needs.image_downscale : 1;
}

}  // namespace

MotionSegmentationNode::MotionSegmentationNode(Bus& bus, const Configuration& configuration)
    : MotionSegmentationNode(bus, configuration, makeDetector(configuration.detection)) {}

MotionSegmentationNode::MotionSegmentationNode(Bus& bus, const Configuration& configuration,
                                               std::unique_ptr<Detector> detector)
    : ImageStage(bus, programName(kMotionSegmentation), configurationHash(configuration),
                 configuration.channels.camera, {configuration.camera.width, configuration.camera.height},
                 fromSeconds(configuration.waits.segmentation_s), detector->needs().camera_motion),
      configuration_(configuration),
      detector_(std::move(detector)),
      adjustable_(dynamic_cast<AdjustableQuality*>(detector_.get())),
      ladder_(adjustable_ != nullptr ? adjustable_->rungs().size() : 0),
      needs_(detector_->needs()),
      camera_(configuration.camera, imageDownscale(needs_, configuration.camera), configuration.own_parts),
      foreground_(publisher(), configuration_, camera_),
      visual_(fromSeconds(configuration.waits.segmentation_s), needs_.camera_motion) {
  const auto& channels = configuration_.channels;
  if (!needs_.camera_motion) return;
  on<fused_homography_t>(channels.fused_homography, [this](const fused_homography_t& m) {
    companions().put(timeOf(m), m, now());
    fused_path_.reset();
    unbridged_.reset();
    health().setCalibration(m.calibration);
  });
  on<visual_homography_t>(channels.visual_homography, [this](const visual_homography_t& m) {
    visual_.put(timeOf(m), m, now());
    unbridged_.reset();
    if (const auto restored = restoredVisual(m)) visual_.putRestored(timeOf(*restored), *restored);
  });
}

void MotionSegmentationNode::reset(CameraTime newest) {
  visual_.eraseAfter(newest);
  fused_path_.reset();
  unbridged_.reset();
  last_.reset();
}

bool MotionSegmentationNode::isLeftOut(CameraTime frame) const {
  const visual_homography_t* visual = visual_.find(frame);
  return visual != nullptr && visual->status == visual_homography_t::SKIPPED;
}

bool MotionSegmentationNode::isWaiting(CameraTime frame) {
  if (ImageStage::isWaiting(frame)) return true;
  if (!needs_.camera_motion || !last_ || fusedPathTo(frame)) return false;
  return isPending(visual_, frame) || isBridgePending(frame);
}

void MotionSegmentationNode::adjustQuality(CameraTime frame) {
  if (adjustable_ == nullptr) return;
  const Duration backlog = isFinishing() ? Duration(0) : backlogOf(frame);
  const size_t before = ladder_.rung();
  const size_t rung = ladder_.update(backlog, fromSeconds(configuration_.waits.segmentation_s));
  if (rung != before) spdlog::warn("quality {} of {}", rung, adjustable_->rungs().size());
  adjustable_->setQuality(rung);
  foreground_.drawOverlays(rung == 0);
}

FrameInput MotionSegmentationNode::inputFor(const image_t& message) {
  FrameInput input;
  input.time = timeOf(message);
  input.time_previous = last_.value_or(input.time);
  input.K = zoomed(camera_.camera().K(), exposureOf(input.time).zoom);
  input.K_previous = zoomed(camera_.camera().K(), zoom_);
  input.size = {camera_.camera().ideal().width, camera_.camera().ideal().height};
  input.sample_grid_px = configuration_.visual.tracker.grid_px;
  if (!last_) return input;
  if (std::optional<FrameStep> step = stepAlong(companions(), *last_, input.time)) {
    input.ground = step->ground;
    input.front = step->front;
    input.motion = step->motion;
    input.tracks = std::move(step->tracks);
  } else {
    input.ground = fusedPathTo(input.time);
    if (!input.ground && !addVisual(input)) {
      input.ground = homographyAlong(allLinks(), *last_, input.time);
    }
  }
  return input;
}

std::vector<HomographyLink> MotionSegmentationNode::allLinks() const {
  std::vector<HomographyLink> links = linksOf(companions());
  for (const HomographyLink& link : linksOf(visual_)) links.push_back(link);
  return links;
}

bool MotionSegmentationNode::isBridged(CameraTime frame) const {
  const std::vector<HomographyLink> links = allLinks();
  std::set<CameraTime> later;
  for (const HomographyLink& link : links) {
    if (link.to > frame) later.insert(link.to);
  }
  return std::any_of(later.begin(), later.end(),
                     [&](CameraTime time) { return homographyAlong(links, *last_, time).has_value(); });
}

bool MotionSegmentationNode::isBridgePending(CameraTime frame) {
  const bool is_too_late = now() - frame > fromSeconds(configuration_.waits.segmentation_s);
  if (isFinishing() || is_too_late || !visual_.isAlive()) return false;
  const visual_homography_t* visual = visual_.find(frame);
  const bool tracks_from_here = visual != nullptr && (visual->status == visual_homography_t::FIRST_FRAME ||
                                                      visual->status == visual_homography_t::NO_PLANE);
  if (tracks_from_here) return false;
  if (unbridged_ == frame) return true;
  if (homographyAlong(allLinks(), *last_, frame) || isBridged(frame)) return false;
  unbridged_ = frame;
  return true;
}

std::optional<Eigen::Matrix3d> MotionSegmentationNode::fusedPathTo(CameraTime frame) {
  if (!fused_path_ || fused_path_->to != frame) {
    fused_path_ = FusedPath{frame, homographyAlong(linksOf(companions()), *last_, frame)};
  }
  return fused_path_->H;
}

bool MotionSegmentationNode::addVisual(FrameInput& input) const {
  const visual_homography_t* visual = visual_.find(input.time);
  if (visual == nullptr || visual->status != visual_homography_t::GOOD || previousTimeOf(*visual) != *last_) {
    return false;
  }
  input.ground = matrix3(visual->ground.H);
  input.tracks = tracksOf(visual->tracks);
  return true;
}

void MotionSegmentationNode::work(const image_t& message) {
  const fused_homography_t* fused = companions().find(timeOf(message));
  FrameInput input = inputFor(message);
  if (needs_.camera_motion && last_ && !input.ground && isBridged(input.time)) {
    noteResultReady();
    updateState(DetectorStatus::kNoHomography, false);
    return publishOutput(message, input,
                         DetectorOutput::empty(input.time, input.size, DetectorStatus::kNoHomography),
                         {std::nullopt, exposureOf(input.time).zoom});
  }
  const Exposure exposure = decodeInto(input, message);
  adjustQuality(input.time);
  const DetectorOutput output = detector_->step(input);
  noteResultReady();
  publishOutput(message, input, output, exposure);
  updateState(output.status, fused != nullptr);
  last_ = input.time;
  zoom_ = exposure.zoom;
  // This frame's messages link the next one; earlier ones do where some were lost.
  companions().eraseBefore(timeOf(message) - kLinking);
  fused_path_.reset();
  visual_.eraseBefore(timeOf(message) - kLinking);
}

Exposure MotionSegmentationNode::exposureOf(CameraTime frame) const {
  Exposure exposure{std::nullopt, zoom_};  // the lens stands as it stood
  if (const visual_homography_t* visual = visual_.find(frame); visual != nullptr && visual->zoom > 0)
    exposure.zoom = visual->zoom;
  if (const fused_homography_t* fused = companions().find(frame)) {
    exposure.rows = rowMotionOf(fused->row_motion);
    if (fused->zoom > 0) exposure.zoom = fused->zoom;
  }
  return exposure;
}

Exposure MotionSegmentationNode::decodeInto(FrameInput& input, const image_t& message) {
  const bool is_colour = needs_.colour && message.pixelformat != image_t::GRAY;
  const IdealImage image = camera_.ideal(message, is_colour, health(), exposureOf(input.time));
  input.grey = image.grey;
  input.colour = image.colour;
  if (needs_.colour && !is_colour && !input.grey.empty()) {
    cv::cvtColor(input.grey, input.colour, cv::COLOR_GRAY2BGR);
  }
  input.own_parts = camera_.rectifier().ownParts(image.exposure);
  return image.exposure;
}

void MotionSegmentationNode::publishOutput(const image_t& message, const FrameInput& input,
                                           DetectorOutput output, const Exposure& exposure) {
  for (Detection& detection : output.detections) detection.id = identities_.globalId(detection.id);
  foreground_.publish(message, input.time_previous, std::move(output), exposure);
}

void MotionSegmentationNode::updateState(DetectorStatus status, bool has_fused) {
  if (status != DetectorStatus::kGood) {
    health().setState(HealthState::kDegraded, toString(status));
  } else if (needs_.camera_motion && !has_fused) {
    health().setState(HealthState::kDegraded, "no fused homography: homography from vision");
  } else if (ladder_.rung() > 0) {
    const std::vector<std::string> rungs = adjustable_->rungs();
    std::string message =
        "overload: quality " + std::to_string(ladder_.rung()) + " of " + std::to_string(rungs.size());
    for (size_t i = 0; i < ladder_.rung(); ++i) message += (i == 0 ? ": " : ", ") + rungs[i];
    if (configuration_.overlay_period_frames > 0) message += ", no overlay";
    health().setState(HealthState::kDegraded, message);
  } else {
    health().setState(HealthState::kGood);
  }
}

}  // namespace redbee
