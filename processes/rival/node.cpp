#include "processes/rival/node.hpp"

#include <opencv2/core/eigen.hpp>

#include "processes/conversions.hpp"
#include "redbee/detection/rivals/graded_score.hpp"
#include "redbee/geometry/time.hpp"
#include "redbee/node/work_timer.hpp"

namespace redbee {
namespace {

constexpr int kFrameQueue = 64;

SegmentationStatus statusOf(RivalStatus status) {
  switch (status) {
    case RivalStatus::kGood:
      return SegmentationStatus::kGood;
    case RivalStatus::kLearning:
      return SegmentationStatus::kLearning;
    case RivalStatus::kLost:
      return SegmentationStatus::kNoHomography;
    case RivalStatus::kBadImage:
      break;
  }
  return SegmentationStatus::kBadImage;
}

Configuration withDecisionScore(Configuration configuration) {
  configuration.segmentation.threshold = (kDecisionScore - 0.5) / 255;
  configuration.segmentation.extent_threshold = configuration.segmentation.threshold;
  return configuration;
}

}  // namespace

RivalNode::RivalNode(Bus& bus, const Configuration& configuration, const std::string& rival)
    : bus_(bus),
      configuration_(withDecisionScore(configuration)),
      name_("rival-" + rival),
      health_(name_, configurationHash(configuration)),
      camera_(configuration.camera),
      publisher_(bus_, configuration_, camera_),
      rival_(makeRival(rival)),
      tracker_(configuration_.segmentation),
      images_(configuration.waits.max_backlog),
      inertial_(fromSeconds(configuration.waits.segmentation_s).count(),
                configuration.has_imu && rival_->wantsMotion()) {
  const auto damaged = [this] { health_.noteDamaged(); };
  const auto& channels = configuration_.channels;
  bus_.subscribe<image_t>(
      channels.camera, kFrameQueue,
      [this](const image_t& m) { images_.take(m, health_, [this] { restart(); }); }, damaged);
  if (!rival_->wantsMotion()) return;
  bus_.subscribe<inertial_homography_t>(
      channels.inertial_homography, kFrameQueue, [this](const inertial_homography_t& m) { takeInertial(m); },
      damaged);
}

void RivalNode::takeInertial(const inertial_homography_t& message) {
  health_.noteSequence(configuration_.channels.inertial_homography, message.sequence);
  if (finiteHomography(message)) {
    inertial_.put(message.utime, message);
  } else {
    health_.noteDamaged();
  }
}

void RivalNode::restart() {
  inertial_.clear();
  last_utime_.reset();
}

void RivalNode::process() {
  images_.workOff(inertial_, health_, [this](const Arrived<image_t>& frame) { work(frame); });
}

void RivalNode::finish() {
  images_.workOffAll([this](const Arrived<image_t>& frame) { work(frame); });
}

RivalInput RivalNode::inputFor(const image_t& message) {
  RivalInput input;
  input.utime = message.utime;
  input.K = camera_.camera().K();
  const IdealImage image = camera_.ideal(message, rival_->wantsColour(), health_);
  input.grey = image.grey;
  input.colour = image.colour;
  const inertial_homography_t* inertial = inertial_.find(message.utime);
  if (inertial != nullptr && inertial->valid != 0 && last_utime_ &&
      inertial->utime_previous == *last_utime_) {
    input.motion = PlaneMotion{matrix3(inertial->R), vector3(inertial->t), vector3(inertial->normal),
                               inertial->plane_distance};
  }
  return input;
}

SegmentationOutput RivalNode::detect(const RivalInput& input) {
  const cv::Size size(camera_.camera().ideal().width, camera_.camera().ideal().height);
  const RivalOutput answer = rival_->step(input);
  SegmentationOutput output;
  output.utime = input.utime;
  output.status = statusOf(answer.status);
  const bool good = output.status == SegmentationStatus::kGood;
  output.unknown = cv::Mat(size, CV_8U, cv::Scalar(good ? 0 : 255));
  output.probability = good ? answer.score : cv::Mat::zeros(size, CV_8U);
  output.mask = cv::Mat::zeros(size, CV_8U);
  std::vector<Detection> components;
  if (good) {
    Eigen::Matrix3d background;
    cv::cv2eigen(answer.background, background);
    tracker_.carry(background);
    ForegroundComponents found =
        findComponents(output.probability, output.unknown, configuration_.segmentation);
    output.mask = found.mask;
    components = std::move(found.components);
  }
  output.detections = tracker_.update(components, size);
  return output;
}

void RivalNode::work(const Arrived<image_t>& frame) {
  FrameTimers timers;
  const int64_t utime = frame.content.utime;
  const SegmentationOutput output = detect(inputFor(frame.content));
  timers.cpu.answered();
  publisher_.publish(frame.content, last_utime_.value_or(utime), output);
  last_utime_ = utime;
  inertial_.eraseThrough(utime);
  const bool good = output.status == SegmentationStatus::kGood;
  health_.setState(good ? HealthState::kGood : HealthState::kDegraded, good ? "" : toString(output.status));
  noteDone(health_, utime, frame.since, timers);
}

}  // namespace redbee
