#include "redbee/detection/ground_detector.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "redbee/detection/objects/candidates.hpp"
#include "redbee/detection/refinement/flow_entropy.hpp"
#include "redbee/imaging/warping.hpp"

namespace redbee {
namespace {

// P_FG * 255 below this is noise, and would be most of the encoded map's bytes.
constexpr double kNoise = 6;

std::optional<GroundPlane> groundOf(const FrameInput& input) {
  if (!input.motion) return std::nullopt;
  const PlaneMotion& motion = *input.motion;
  const Eigen::Vector3d normal = motion.R_ba * motion.m_a;
  return GroundPlane{normal, motion.h_a + normal.dot(motion.t_ba), input.K};
}

}  // namespace

GroundDetector::GroundDetector(const DetectionParameters& parameters)
    : learning_frames_(parameters.learning_frames),
      refinement_(parameters.refinement),
      objects_(parameters.objects),
      image_check_(parameters.min_contrast),
      probability_(parameters.refinement),
      tracker_(parameters.objects, parameters.parallax) {}

DetectorOutput GroundDetector::step(const FrameInput& frame) {
  const bool continues = isConsecutive(frame);
  if (!frame.fullSize().empty() && frame.fullSize() != size_) {
    tracker_.reset();
    image_check_.reset();
    size_ = frame.fullSize();
  }
  last_time_ = frame.time;
  const int downscale = frame.grey.empty() ? 1 : std::max(1, size_.width / frame.grey.cols);
  const ImageContent content = image_check_.classify(frame.grey, downscale);
  const bool is_repeated = content == ImageContent::kRepeated || content == ImageContent::kFrozen;
  if (is_repeated && continues && held_.covers(frame.time)) return held_.hold(frame);
  image_check_.setReference(frame.grey);
  const FrameInput input = continues ? held_.sinceImage(frame) : frame;
  held_.reset();  // before the maps of this image are made
  DetectorOutput output = process(input, continues, content);
  processed_time_ = frame.time;
  if (output.status != DetectorStatus::kBadImage) held_.begin(output);
  return output;
}

DetectorOutput GroundDetector::process(const FrameInput& input, bool continues, ImageContent content) {
  const bool is_first = !processed_time_;
  const Duration elapsed = is_first ? Duration(0) : input.time - *processed_time_;
  if (continues) {
    propagate(input);
  } else {
    reset();
  }
  const bool is_camera_known = continues && input.motion;
  tracker_.propagate(
      elapsed, continues ? input.ground : std::nullopt,
      is_camera_known ? std::optional(CameraStep{*input.motion, input.cameras()}) : std::nullopt);
  const auto nothing = [&](DetectorStatus status) {
    DetectorOutput output = DetectorOutput::empty(input.time, size_, status);
    output.detections = tracker_.skip(size_);
    return output;
  };
  if (content == ImageContent::kUnusable || content == ImageContent::kFrozen)
    return nothing(DetectorStatus::kBadImage);
  ForegroundMaps maps = learn(input);
  if (maps.foreground.empty()) maps.foreground = cv::Mat1b::zeros(size_);
  if (maps.unknown.empty()) maps.unknown = cv::Mat1b(size_, 255);
  if (!input.own_parts.empty()) maps.unknown |= input.own_parts;
  cv::Mat1b probability = refinement_.enabled ? refined(maps.foreground, input) : maps.foreground;
  ++learned_;
  if (!continues && !is_first) return nothing(DetectorStatus::kNoHomography);
  if (learned_ <= learning_frames_) return nothing(DetectorStatus::kLearning);
  return withObjects(input, std::move(probability), maps);
}

bool GroundDetector::isConsecutive(const FrameInput& input) const {
  return last_time_ && input.time > *last_time_ && input.time_previous == *last_time_ &&
         input.fullSize() == size_ && input.ground && isUsableHomography(*input.ground);
}

void GroundDetector::reset() {
  resetBackground();
  probability_.reset();
  learned_ = 0;
}

void GroundDetector::propagate(const FrameInput& input) {
  warpBackground(input);
  probability_.propagate(*input.ground);
}

cv::Mat1b GroundDetector::refined(const cv::Mat1b& foreground, const FrameInput& input) {
  cv::Mat1f evidence, order;
  foreground.convertTo(evidence, CV_32F, 1.0 / 255);
  if (refinement_.use_entropy && input.ground) {
    order = flowOrder(input.tracks, input.sample_grid_px, *input.ground, size_, refinement_);
  }
  cv::Mat1b probability;
  probability_.update(evidence, order).convertTo(probability, CV_8U, 255);
  return probability;
}

ForegroundComponents GroundDetector::components(const FrameInput& input, const cv::Mat1b& probability,
                                                const ForegroundMaps& maps) const {
  if (maps.appearance.empty())
    return findComponents(probability, maps.unknown, objects_, {maps.gain, maps.residual, maps.moving});
  const std::vector<Candidate> candidates =
      findCandidates(maps, maps.unknown, groundOf(input), objectTrees());
  if (observer_) observer_(input.time, maps.appearance.size(), candidates);
  return componentsOf(candidates, probability, maps.unknown, objects_, maps);
}

DetectorOutput GroundDetector::withObjects(const FrameInput& input, cv::Mat1b probability,
                                           const ForegroundMaps& maps) {
  DetectorOutput output;
  output.time = input.time;
  output.status = DetectorStatus::kGood;
  output.unknown = maps.unknown;
  probability.setTo(0, maps.unknown);
  cv::threshold(probability, probability, kNoise, 0, cv::THRESH_TOZERO);
  output.probability = std::move(probability);
  ForegroundComponents found = components(input, output.probability, maps);
  TrackedObjects objects = tracker_.update(found);
  output.mask = found.mask(objects.components);
  output.detections = std::move(objects.detections);
  return output;
}

}  // namespace redbee
