#include "processes/motion_segmentation/node.hpp"

#include <Eigen/LU>
#include <opencv2/imgproc.hpp>

#include "flight/overlay.hpp"
#include "messaging/picture.hpp"
#include "processes/conversions.hpp"
#include "processes/work_timer.hpp"
#include "redbee/detections_t.hpp"
#include "redbee/foreground_t.hpp"

namespace redbee {
namespace {

constexpr int kFrameQueue = 64;
constexpr int kOverlayQuality = 80;
constexpr int8_t kVisualGood = 0;

detections_t detectionsMessage(const SegmentationOutput& output) {
  detections_t message{};
  message.utime = output.utime;
  message.status = static_cast<int8_t>(output.status);
  message.n = static_cast<int32_t>(output.detections.size());
  for (const Detection& detection : output.detections) {
    detection_t d{};
    d.id = detection.id;
    d.x = detection.box.x;
    d.y = detection.box.y;
    d.width = detection.box.width;
    d.height = detection.box.height;
    d.area = detection.area_px;
    d.score = detection.score;
    d.seen = detection.seen ? 1 : 0;
    message.detections.push_back(d);
  }
  return message;
}

/// Box on the raw grid around a box on the ideal grid.
cv::Rect rawBox(const Camera& camera, const cv::Rect& box) {
  const cv::Rect picture(0, 0, camera.intrinsics().width, camera.intrinsics().height);
  Eigen::Vector2d low(picture.width, picture.height);
  Eigen::Vector2d high(0, 0);
  for (int i = 0; i <= 4; ++i) {
    for (const Eigen::Vector2d& edge : {Eigen::Vector2d(i / 4.0, 0), Eigen::Vector2d(i / 4.0, 1),
                                        Eigen::Vector2d(0, i / 4.0), Eigen::Vector2d(1, i / 4.0)}) {
      const Eigen::Vector2d raw =
          camera.distort({box.x + edge.x() * (box.width - 1), box.y + edge.y() * (box.height - 1)});
      low = low.cwiseMin(raw);
      high = high.cwiseMax(raw);
    }
  }
  const cv::Point top_left(static_cast<int>(std::floor(low.x())), static_cast<int>(std::floor(low.y())));
  const cv::Point bottom_right(static_cast<int>(std::ceil(high.x())) + 1,
                               static_cast<int>(std::ceil(high.y())) + 1);
  return cv::Rect(top_left, bottom_right) & picture;
}

}  // namespace

MotionSegmentationNode::MotionSegmentationNode(Bus& bus, const Configuration& configuration)
    : bus_(bus),
      configuration_(configuration),
      health_("redbee-motion-segmentation", configurationHash(configuration)),
      camera_(configuration.camera),
      rectifier_(camera_),
      segmenter_(configuration.segmentation),
      pictures_(configuration.waits.max_backlog),
      fused_(microseconds(configuration.waits.segmentation_s), true),
      visual_(0, false) {
  const auto damaged = [this] { health_.noteDamaged(); };
  const auto& channels = configuration_.channels;
  bus_.subscribe<image_t>(
      channels.camera, kFrameQueue,
      [this](const image_t& m) { pictures_.take(m, health_, [this] { restart(); }); }, damaged);
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
  calibration_.note(fused.test_ratio,
                    meanTransferError(planeHomography(camera_.K(), motion), matrix3(fused.H_observed),
                                      configuration_.camera.width, configuration_.camera.height));
  health_.setCalibration(calibration_.verdict());
}

void MotionSegmentationNode::restart() {
  fused_.clear();
  visual_.clear();
  last_.reset();
}

void MotionSegmentationNode::process() {
  pictures_.workOff(fused_, health_, [this](const Arrived<image_t>& frame) { segment(frame); });
}

void MotionSegmentationNode::finish() {
  pictures_.workOffAll([this](const Arrived<image_t>& frame) { segment(frame); });
}

SegmentationInput MotionSegmentationNode::inputFor(const image_t& message) const {
  SegmentationInput input;
  input.utime = message.utime;
  input.utime_previous = last_ ? last_->utime : message.utime;
  input.K = camera_.K();
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
    // A frame between was missed: the anchor bridges it (method.md, "Fusion"). A fusion that was started
    // again counts its epochs anew, but not its anchors.
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
  const WorkTimer timer;
  const image_t& message = frame.content;
  SegmentationInput input = inputFor(message);
  decodeInto(input, message);
  publish(message, input, segmenter_.step(input));
  if (const fused_homography_t* fused = fused_.find(message.utime)) {
    last_ = Last{message.utime, fused->epoch, fused->utime_anchor, matrix3(fused->H_anchor)};
  } else {
    last_ = Last{message.utime, -1, 0, Eigen::Matrix3d::Identity()};
  }
  fused_.forgetUpTo(message.utime);
  visual_.forgetUpTo(message.utime);
  noteDone(health_, message.utime, frame.since, timer);
}

void MotionSegmentationNode::decodeInto(SegmentationInput& input, const image_t& message) {
  const bool wants_colour =
      configuration_.segmentation.method == SegmentationMethod::kParallax && message.pixelformat != kGray;
  const cv::Mat picture = (wants_colour ? decodeColour(message) : decodeGrey(message)).value_or(cv::Mat());
  const cv::Size size(configuration_.camera.width, configuration_.camera.height);
  if (picture.size() != size) {
    if (picture.empty()) health_.noteDamaged();
    input.grey = cv::Mat::zeros(size, CV_8U);
    return;
  }
  if (!wants_colour) {
    input.grey = rectifier_.toIdeal(picture);
    return;
  }
  input.colour = rectifier_.toIdeal(picture);
  cv::cvtColor(input.colour, input.grey, cv::COLOR_BGR2GRAY);
}

void MotionSegmentationNode::publish(const image_t& message, const SegmentationInput& input,
                                     SegmentationOutput output) {
  output.probability = rectifier_.toRaw(output.probability);
  output.mask = rectifier_.toRaw(output.mask);
  output.unknown = rectifier_.toRaw(output.unknown);
  for (Detection& detection : output.detections) detection.id = identities_.told(detection.id);
  if (camera_.isDistorted()) {
    for (Detection& detection : output.detections) detection.box = rawBox(camera_, detection.box);
  }
  foreground_t foreground{};
  foreground.utime = output.utime;
  foreground.utime_previous = input.utime_previous;
  foreground.sequence = sequence_;
  foreground.status = static_cast<int8_t>(output.status);
  foreground.width = output.mask.cols;
  foreground.height = output.mask.rows;
  foreground.probability = encodePng(output.probability);
  foreground.mask = encodePng(output.mask);
  foreground.unknown = encodePng(output.unknown);
  foreground.probability_size = static_cast<int32_t>(foreground.probability.size());
  foreground.mask_size = static_cast<int32_t>(foreground.mask.size());
  foreground.unknown_size = static_cast<int32_t>(foreground.unknown.size());
  bus_.publish(configuration_.channels.foreground, foreground);

  detections_t detections = detectionsMessage(output);
  detections.sequence = sequence_++;
  bus_.publish(configuration_.channels.detections, detections);
  publishOverlay(message, output);
  if (output.status != SegmentationStatus::kGood) {
    health_.setState(HealthState::kDegraded, toString(output.status));
  } else if (fused_.find(output.utime) == nullptr) {
    health_.setState(HealthState::kDegraded, "the fusion is away: homography from vision");
  } else {
    health_.setState(HealthState::kGood);
  }
}

void MotionSegmentationNode::publishOverlay(const image_t& message, const SegmentationOutput& output) {
  const int period = configuration_.overlay_period_frames;
  if (period == 0 || ++frames_since_overlay_ < period) return;
  frames_since_overlay_ = 0;
  if (const auto picture = decodeColour(message); picture && picture->size() == output.mask.size()) {
    OverlayStatus status;
    status.utime = message.utime;
    status.message = output.status == SegmentationStatus::kGood ? "" : toString(output.status);
    const cv::Mat drawn = drawOverlay(*picture, output.mask, output.detections, status);
    bus_.publish(configuration_.channels.overlay, jpegMessage(message.utime, drawn, kOverlayQuality));
  }
}

}  // namespace redbee
