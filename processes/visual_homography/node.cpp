#include "processes/visual_homography/node.hpp"

#include <Eigen/Cholesky>

#include "processes/conversions.hpp"
#include "processes/note_calibration.hpp"
#include "redbee/bus/image.hpp"
#include "redbee/configuration/process_table.hpp"
#include "redbee/geometry/chi_square.hpp"
#include "redbee/geometry/time.hpp"
#include "redbee/node/work_timer.hpp"

namespace redbee {
namespace {

constexpr int kFrameQueue = 64;
constexpr int8_t kImageDoesNotFit = 4;

}  // namespace

VisualHomographyNode::VisualHomographyNode(Bus& bus, const Configuration& configuration)
    : bus_(bus),
      configuration_(configuration),
      health_(programName(kVisualHomography), configurationHash(configuration)),
      camera_(configuration.camera),
      rectifier_(camera_),
      estimator_(std::make_unique<VisualHomographyEstimator>(configuration.visual, rectifier_.unseen())),
      images_(configuration.waits.max_backlog),
      inertial_(fromSeconds(configuration.waits.visual_s).count(), configuration.has_imu) {
  const auto damaged = [this] { health_.noteDamaged(); };
  const auto& channels = configuration_.channels;
  bus_.subscribe<image_t>(
      channels.camera, kFrameQueue,
      [this](const image_t& m) { images_.take(m, health_, [this] { restart(); }); }, damaged);
  bus_.subscribe<inertial_homography_t>(
      channels.inertial_homography, kFrameQueue, [this](const inertial_homography_t& m) { takeInertial(m); },
      damaged);
}

void VisualHomographyNode::takeInertial(const inertial_homography_t& message) {
  health_.noteSequence(configuration_.channels.inertial_homography, message.sequence);
  if (!plausibleTimes(message) || !finiteHomography(message)) {
    health_.noteDamaged();
    return;
  }
  inertial_.put(message.utime, message);
}

void VisualHomographyNode::restart() {
  inertial_.clear();
  estimator_ = std::make_unique<VisualHomographyEstimator>(configuration_.visual, rectifier_.unseen());
}

std::optional<HomographyPrediction> VisualHomographyNode::prediction(int64_t utime) const {
  const auto from = estimator_->previousTime();
  if (!from) return std::nullopt;
  const ImageScaling scaling(camera_.ideal().width, camera_.ideal().height);
  std::optional<HomographyPrediction> chain;
  for (int64_t at = utime; at > toUtime(*from);) {
    const inertial_homography_t* link = inertial_.find(at);
    if (link == nullptr || link->valid == 0 || link->utime_previous >= at) return std::nullopt;
    const HomographyPrediction step{matrix3(link->H), matrix8(link->covariance)};
    if (!chain) {
      chain = step;
    } else {
      const auto J = composeJacobians(scaling.scale(chain->H), scaling.scale(step.H));
      chain->covariance = J.by_left * chain->covariance * J.by_left.transpose() +
                          J.by_right * step.covariance * J.by_right.transpose();
      chain->H = normaliseHomography(chain->H * step.H);
    }
    at = link->utime_previous;
    if (at < toUtime(*from)) return std::nullopt;
  }
  return chain;
}

void VisualHomographyNode::process() {
  images_.workOff(inertial_, health_, [this](const Arrived<image_t>& frame) { track(frame); });
}

void VisualHomographyNode::finish() {
  images_.workOffAll([this](const Arrived<image_t>& frame) { track(frame); });
}

void VisualHomographyNode::track(const Arrived<image_t>& frame) {
  FrameTimers timers;
  const image_t& message = frame.content;
  const CameraTime time(fromUtime(message.utime));
  const auto grey = decodeGrey(message);
  if (!grey || grey->cols != configuration_.camera.width || grey->rows != configuration_.camera.height) {
    if (!grey) health_.noteDamaged();
    visual_homography_t refusal{};
    refusal.utime = message.utime;
    refusal.utime_previous = toUtime(estimator_->previousTime().value_or(time));
    refusal.sequence = sequence_++;
    refusal.status = kImageDoesNotFit;
    refusal.width = camera_.ideal().width;
    refusal.height = camera_.ideal().height;
    bus_.publish(configuration_.channels.visual_homography, refusal);
    noteDone(health_, message.utime, frame.since, timers);
    health_.setState(HealthState::kDegraded,
                     "image is " + std::to_string(message.width) + "x" + std::to_string(message.height) +
                         " or damaged; configured are " + std::to_string(configuration_.camera.width) + "x" +
                         std::to_string(configuration_.camera.height));
    return;
  }
  const auto predicted = prediction(message.utime);
  const VisualHomography result = estimator_->step(time, rectifier_.toIdeal(*grey), predicted);
  timers.cpu.answered();
  publish(result);
  if (predicted && result.ground) judgeCalibration(*predicted, result);
  // After a image that nothing could be tracked in, the next one is tracked from an earlier frame: its
  // links are still needed.
  inertial_.eraseThrough(toUtime(estimator_->previousTime().value_or(time)));
  noteDone(health_, message.utime, frame.since, timers);
}

void VisualHomographyNode::judgeCalibration(const HomographyPrediction& prediction,
                                            const VisualHomography& result) {
  const ImageScaling scaling(camera_.ideal().width, camera_.ideal().height);
  const Vector8d difference =
      toVector(scaling.scale(result.ground->H)) - toVector(scaling.scale(prediction.H));
  const Matrix8d S =
      prediction.covariance + configuration_.fusion.visual_inflation * result.ground->covariance;
  const double gate = chiSquareQuantile(configuration_.fusion.gate_probability, 8);
  noteCalibration(calibration_, health_, difference.dot(S.ldlt().solve(difference)) / gate, prediction.H,
                  result.ground->H, camera_.ideal());
}

void VisualHomographyNode::publish(const VisualHomography& result) {
  visual_homography_t message{};
  message.utime = toUtime(result.time);
  message.utime_previous = toUtime(result.time_previous);
  message.sequence = sequence_++;
  message.status = static_cast<int8_t>(result.status);
  message.width = camera_.ideal().width;
  message.height = camera_.ideal().height;
  message.sampled = result.tracks.sampled;
  fillTracks(message, result.tracks);
  message.inlier.assign(result.tracks.current.size(), 0);
  if (result.ground) {
    fill(message.H, result.ground->H);
    fill(message.covariance, result.ground->covariance);
    message.inliers = result.ground->inliers;
    message.outliers = result.ground->outliers;
    message.rms = result.ground->rms_px;
    message.inlier.assign(result.ground->inlier.begin(), result.ground->inlier.end());
  }
  bus_.publish(configuration_.channels.visual_homography, message);
  const bool good = result.status == VisualStatus::kGood;
  health_.setState(good ? HealthState::kGood : HealthState::kDegraded, good ? "" : toString(result.status));
}

}  // namespace redbee
