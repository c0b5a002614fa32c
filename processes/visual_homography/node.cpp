#include "processes/visual_homography/node.hpp"

#include "processes/conversions.hpp"
#include "redbee/bus/image.hpp"
#include "redbee/configuration/process_table.hpp"
#include "redbee/geometry/time.hpp"

namespace redbee {
VisualHomographyNode::VisualHomographyNode(Bus& bus, const Configuration& configuration)
    : ImageStage(bus, programName(kVisualHomography), configurationHash(configuration),
                 configuration.channels.camera, {configuration.camera.width, configuration.camera.height},
                 fromSeconds(configuration.waits.visual_s), configuration.expectsInertial()),
      configuration_(configuration),
      camera_(configuration.camera),
      rectifier_(camera_, configuration.own_parts),
      estimator_(std::make_unique<VisualHomographyEstimator>(configuration.visual, rectifier_.unknown())) {
  on<inertial_homography_t>(configuration_.channels.inertial_homography,
                            [this](const inertial_homography_t& m) {
                              companions().put(timeOf(m), m, now());
                              const auto restored = restoredInertial(m);
                              if (restored) companions().putRestored(timeOf(*restored), *restored);
                            });
}

void VisualHomographyNode::reset(CameraTime) {
  estimator_ = std::make_unique<VisualHomographyEstimator>(configuration_.visual, rectifier_.unknown(zoom_));
  earlier_ = {};
  row_motion_.reset();
}

std::optional<HomographyPrediction> VisualHomographyNode::prediction(CameraTime time) const {
  const auto from = estimator_->previousTime();
  if (!from) return std::nullopt;
  const ImageScaling scaling(camera_.ideal().width, camera_.ideal().height);
  std::optional<HomographyPrediction> chain;
  for (CameraTime at = time; at > *from;) {
    const inertial_homography_t* link = companions().find(at);
    if (link == nullptr || link->valid == 0 || previousTimeOf(*link) >= at) return std::nullopt;
    const HomographyPrediction step{matrix3(link->ground.H), matrix8(link->ground.covariance)};
    chain = chain ? compose(*chain, step, scaling) : step;
    at = previousTimeOf(*link);
    if (at < *from) return std::nullopt;
  }
  return chain;
}

void VisualHomographyNode::work(const image_t& message) {
  const auto grey = decodeGrey(message);
  if (!grey) {
    health().noteDamaged();
    publishNone(timeOf(message), visual_homography_t::IMAGE_DOES_NOT_FIT);
    return health().setState(HealthState::kDegraded, "the image is damaged");
  }
  const CameraTime time = timeOf(message);
  const auto predicted = prediction(time);
  const VisualHomography result = estimator_->step(time, rectified(*grey, time), predicted);
  noteResultReady();
  publishResult(result);
  // After an image without tracks the next one is tracked from an earlier frame, so inertial messages since
  // then are still needed.
  companions().eraseThrough(estimator_->previousTime().value_or(time));
}

cv::Mat1b VisualHomographyNode::rectified(const cv::Mat1b& raw, CameraTime time) {
  followLens(time);
  const inertial_homography_t* inertial = companions().find(time);
  const auto measured = inertial == nullptr ? std::nullopt : rowMotionOf(inertial->row_motion);
  return rectifier_.toIdeal(raw, {row_motion_.of(raw, measured), zoom_});
}

/// Where nothing says it, the lens stands as it stood.
void VisualHomographyNode::followLens(CameraTime time) {
  const inertial_homography_t* inertial = companions().find(time);
  const double zoom = inertial == nullptr ? zoom_ : zoomOf(*inertial);
  if (zoom == zoom_) return;
  zoom_ = zoom;
  estimator_->setUnknown(rectifier_.unknown(zoom));
}

void VisualHomographyNode::publishNone(CameraTime frame, int8_t status) {
  visual_homography_t message{};
  message.utime_previous = toUtime(estimator_->previousTime().value_or(frame));
  message.status = status;
  message.width = camera_.ideal().width;
  message.height = camera_.ideal().height;
  message.zoom = zoom_;
  message.earlier = earlier_;
  publish(configuration_.channels.visual_homography, message);
}

void VisualHomographyNode::noteLeftOut(CameraTime frame) {
  publisher().beginFrame(frame);
  publishNone(frame, visual_homography_t::SKIPPED);
}

void VisualHomographyNode::noteMissing(CameraTime frame) {
  publisher().beginFrame(frame);
  publishNone(frame, visual_homography_t::NO_IMAGE);
}

void VisualHomographyNode::publishResult(const VisualHomography& result) {
  visual_homography_t message{};
  message.utime_previous = toUtime(result.time_previous);
  message.status = static_cast<int8_t>(result.status);
  message.width = camera_.ideal().width;
  message.height = camera_.ideal().height;
  message.zoom = zoom_;
  message.sampled = result.tracks.sampled;
  fill(message.tracks, result.tracks, result.ground ? result.ground->inlier : std::vector<uint8_t>{});
  if (result.ground) {
    fill(message.ground, result.ground->H, result.ground->covariance);
    message.inliers = result.ground->inliers;
    message.outliers = result.ground->outliers;
    message.rms = result.ground->rms_px;
  }
  message.earlier = earlier_;
  publish(configuration_.channels.visual_homography, message);
  const bool good = result.status == VisualStatus::kGood;
  earlier_ = stepOf(message, result.time, result.ground && good);
  health().setState(good ? HealthState::kGood : HealthState::kDegraded, good ? "" : toString(result.status));
}

}  // namespace redbee
