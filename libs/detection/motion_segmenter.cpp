#include "redbee/detection/motion_segmenter.hpp"

#include <opencv2/imgproc.hpp>

#include "redbee/detection/image_check.hpp"
#include "redbee/detection/parallax/foreground_evidence.hpp"
#include "redbee/detection/parallax/parallax_segment.hpp"
#include "redbee/detection/two_planes/flow_entropy.hpp"
#include "redbee/detection/two_planes/foreground_probability.hpp"
#include "redbee/detection/two_planes/two_plane_background.hpp"
#include "redbee/imaging/warping.hpp"

namespace redbee {

const char* toString(SegmentationStatus status) {
  switch (status) {
    case SegmentationStatus::kGood:
      return "good";
    case SegmentationStatus::kLearning:
      return "learning";
    case SegmentationStatus::kNoHomography:
      return "no homography";
    case SegmentationStatus::kBadImage:
      return "bad image";
  }
  return "?";
}

class MotionSegmenter::Implementation {
 public:
  explicit Implementation(const SegmentationParameters& parameters)
      : parameters_(parameters),
        image_check_(parameters),
        planes_(parameters),
        evidence_(parameters),
        probability_(parameters),
        tracker_(parameters) {}

  SegmentationOutput step(const SegmentationInput& input) {
    const bool continues = followsOn(input);
    const bool is_first = last_utime_ == kNever;
    if (!input.grey.empty() && sizeOf(input) != size_) {
      tracker_.reset();
      image_check_.reset();
      size_ = sizeOf(input);
    }
    last_utime_ = input.utime;
    if (continues) {
      carry(input);
    } else {
      forget();
    }
    SegmentationOutput output = emptyOutput(input);
    if (!image_check_.accepts(input.grey)) {
      output.status = SegmentationStatus::kBadImage;
      output.detections = tracker_.skip(size_);
      return output;
    }
    const BackgroundVerdict verdict = learn(input, output);
    ++learned_;
    if (!continues && !is_first) {
      output.status = SegmentationStatus::kNoHomography;
    } else if (learned_ <= parameters_.learning_frames) {
      output.status = SegmentationStatus::kLearning;
    } else {
      judge(verdict, output);
    }
    if (output.status != SegmentationStatus::kGood) {
      output.probability.setTo(0);
      output.detections = tracker_.skip(size_);
    }
    return output;
  }

 private:
  static constexpr int64_t kNever = INT64_MIN;

  static cv::Size sizeOf(const SegmentationInput& input) {
    return input.size.empty() ? input.grey.size() : input.size;
  }

  bool followsOn(const SegmentationInput& input) const {
    return last_utime_ != kNever && input.utime > last_utime_ && input.utime_previous == last_utime_ &&
           sizeOf(input) == size_ && input.ground && isUsableHomography(*input.ground);
  }

  void forget() {
    planes_.reset();
    evidence_.reset();
    probability_.reset();
    learned_ = 0;
  }

  void carry(const SegmentationInput& input) {
    if (parameters_.method == SegmentationMethod::kTwoPlanes) {
      planes_.carry(*input.ground, input.front);
    } else {
      const bool structure = input.front && runsOutOfImage(input.tracks, *input.ground, *input.front, size_);
      evidence_.carry(*input.ground, structure ? input.front : std::nullopt, input.motion, input.K);
    }
    probability_.carry(*input.ground);
    tracker_.carry(*input.ground);
  }

  SegmentationOutput emptyOutput(const SegmentationInput& input) const {
    SegmentationOutput output;
    output.utime = input.utime;
    output.probability = cv::Mat::zeros(size_, CV_8U);
    output.mask = cv::Mat::zeros(size_, CV_8U);
    output.unknown = cv::Mat(size_, CV_8U, cv::Scalar(255));
    return output;
  }

  /// Learns the image; leaves P_FG in probability_map_.
  BackgroundVerdict learn(const SegmentationInput& input, SegmentationOutput& output) {
    BackgroundVerdict verdict;
    if (parameters_.method == SegmentationMethod::kTwoPlanes) {
      verdict = planes_.learn(input.grey);
    } else {
      ForegroundEvidence::Verdict found =
          evidence_.learn(input.utime, input.grey, input.colour, input.K, size_);
      verdict.foreground = found.foreground.empty() ? cv::Mat::zeros(size_, CV_8U) : found.foreground;
      verdict.unknown = found.unseen.empty() ? output.unknown : found.unseen;
    }
    probability_map_ = parameters_.use_refinement ? refined(verdict.foreground, input) : verdict.foreground;
    return verdict;
  }

  cv::Mat refined(const cv::Mat& foreground, const SegmentationInput& input) {
    cv::Mat evidence, order, probability;
    foreground.convertTo(evidence, CV_32F, 1.0 / 255);
    if (parameters_.use_entropy && input.ground) {
      order = flowOrder(input.tracks, *input.ground, size_, parameters_);
    }
    probability_.update(evidence, order).convertTo(probability, CV_8U, 255);
    return probability;
  }

  void judge(const BackgroundVerdict& verdict, SegmentationOutput& output) {
    output.status = SegmentationStatus::kGood;
    output.unknown = verdict.unknown;
    probability_map_.setTo(0, verdict.unknown);
    // Less than this is noise, and would make most of the map's bytes on the wire.
    constexpr double kNoise = 6;
    cv::threshold(probability_map_, output.probability, kNoise, 0, cv::THRESH_TOZERO);
    ForegroundComponents found = findComponents(output.probability, verdict.unknown, parameters_);
    output.mask = found.mask;
    output.detections = tracker_.update(found.components, size_);
  }

  SegmentationParameters parameters_;
  ImageCheck image_check_;
  TwoPlaneBackground planes_;
  ForegroundEvidence evidence_;
  ForegroundProbability probability_;
  ObjectTracker tracker_;
  cv::Mat probability_map_;  ///< CV_8U, P_FG * 255
  cv::Size size_;
  int64_t last_utime_ = kNever;
  int learned_ = 0;
};

MotionSegmenter::MotionSegmenter(const SegmentationParameters& parameters)
    : implementation_(std::make_unique<Implementation>(parameters)) {}

MotionSegmenter::~MotionSegmenter() = default;

SegmentationOutput MotionSegmenter::step(const SegmentationInput& input) {
  return implementation_->step(input);
}

}  // namespace redbee
