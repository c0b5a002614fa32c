#include "processes/rival/node.hpp"

#include <opencv2/core/eigen.hpp>
#include <utility>

#include "processes/conversions.hpp"
#include "redbee/detection/rivals/graded_score.hpp"
#include "redbee/geometry/time.hpp"

namespace redbee {
namespace {

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
    : RivalNode(bus, configuration, rival, makeRival(rival)) {}

RivalNode::RivalNode(Bus& bus, const Configuration& configuration, const std::string& name,
                     std::unique_ptr<Rival> rival)
    : ImageStage(
          bus, "rival-" + name, configurationHash(configuration), configuration.channels.camera,
          configuration.waits.max_backlog,
          {fromSeconds(configuration.waits.segmentation_s), configuration.has_imu && rival->wantsMotion()}),
      configuration_(withDecisionScore(configuration)),
      camera_(configuration.camera),
      foreground_(publisher(), configuration_, camera_),
      rival_(std::move(rival)),
      tracker_(configuration_.segmentation) {
  if (!rival_->wantsMotion()) return;
  on<inertial_homography_t>(configuration_.channels.inertial_homography,
                            [this](const inertial_homography_t& m) {
                              if (!finiteHomography(m)) return false;
                              companions().put(timeOf(m), m);
                              return true;
                            });
}

RivalInput RivalNode::inputFor(const image_t& message) {
  RivalInput input;
  input.utime = message.utime;
  input.K = camera_.camera().K();
  const IdealImage image = camera_.ideal(message, rival_->wantsColour(), health());
  input.grey = image.grey;
  input.colour = image.colour;
  const inertial_homography_t* inertial = companions().find(timeOf(message));
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

void RivalNode::work(const image_t& message) {
  const SegmentationOutput output = detect(inputFor(message));
  noteAnswered();
  foreground_.publish(message, last_utime_.value_or(message.utime), output);
  last_utime_ = message.utime;
  companions().eraseThrough(timeOf(message));
  const bool good = output.status == SegmentationStatus::kGood;
  health().setState(good ? HealthState::kGood : HealthState::kDegraded, good ? "" : toString(output.status));
}

}  // namespace redbee
