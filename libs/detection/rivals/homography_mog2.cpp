#include "redbee/detection/rivals/homography_mog2.hpp"

#include <opencv2/imgproc.hpp>

#include "redbee/detection/rivals/graded_score.hpp"
#include "redbee/imaging/warping.hpp"

namespace redbee {
namespace {

constexpr int kHistory = 100;         // frames; OpenCV's default of 500 is longer than a scene stays in view
constexpr double kVarThreshold = 16;  // OpenCV's default
constexpr double kMinOverlap = 0.6;
constexpr int kLearningFrames = 5;
constexpr float kDifferenceUnit = 30;  // grey levels: difference at the middle of each half of the scale
constexpr int kAveragePx = 15;
constexpr float kDecisionFraction = 0.38F;
constexpr uint8_t kMog2Foreground = 255;

double overlap(const cv::Matx33d& H, cv::Size size) {
  const cv::Mat1b outside = outsidePrevious(H, size);
  return 1.0 - static_cast<double>(cv::countNonZero(outside)) / static_cast<double>(outside.total());
}

/// Largest of the channels' absolute differences.
cv::Mat1b greatestDifference(const cv::Mat3b& a, const cv::Mat3b& b) {
  cv::Mat3b difference;
  cv::absdiff(a, b, difference);
  std::vector<cv::Mat1b> channels;
  cv::split(difference, channels);
  return cv::max(cv::max(channels[0], channels[1]), channels[2]);
}

cv::Mat1b grade(const cv::Mat1b& mask, const cv::Mat1b& difference) {
  cv::Mat1f statistic;
  difference.convertTo(statistic, CV_32F);
  cv::Mat1b half;
  gradedScore(statistic, kDifferenceUnit).convertTo(half, CV_8U, 0.5, -0.5);
  cv::add(half, cv::Scalar(kDecisionScore), half, mask == kMog2Foreground);
  return half;
}

}  // namespace

void HomographyMog2::reset() {
  registrar_.reset();
  model_.release();
  learned_ = 0;
}

void HomographyMog2::setAnchor(const cv::Mat3b& background) {
  model_ = cv::createBackgroundSubtractorMOG2(kHistory, kVarThreshold, true);
  anchor_ = cv::Matx33d::eye();
  cv::Mat1b mask;
  model_->apply(background, mask);
}

cv::Mat1b HomographyMog2::learn(const cv::Mat3b& image) {
  cv::Mat3b background;
  model_->getBackgroundImage(background);
  const cv::Mat1b outside = outsidePrevious(anchor_.inv(), image.size());
  cv::Mat3b laid = warpToCurrent(image, anchor_.inv(), cv::INTER_LINEAR);
  background.copyTo(laid, outside);
  cv::Mat1b mask;
  model_->apply(laid, mask);
  mask.setTo(0, outside);
  return warpToCurrent(grade(mask, greatestDifference(laid, background)), anchor_, cv::INTER_NEAREST);
}

RivalScore HomographyMog2::scoreFrame(const FrameInput& input) {
  RivalScore scored;
  const bool first = !registrar_.hasPrevious();
  const auto registration = registrar_.advance(input.grey);
  if (first) {
    setAnchor(input.colour);
    return scored;
  }
  if (!registration) {
    scored.status = DetectorStatus::kNoHomography;
    return scored;
  }
  anchor_ = *registration * anchor_;
  if (overlap(anchor_, input.grey.size()) < kMinOverlap) {
    cv::Mat3b background;
    model_->getBackgroundImage(background);
    cv::Mat3b here = warpToCurrent(background, anchor_, cv::INTER_LINEAR);
    input.colour.copyTo(here, outsidePrevious(anchor_, here.size()));
    setAnchor(here);
  }
  scored.score = averagedScore(learn(input.colour), kAveragePx, kDecisionFraction);
  scored.background = *registration;
  scored.status = ++learned_ < kLearningFrames ? DetectorStatus::kLearning : DetectorStatus::kGood;
  return scored;
}

}  // namespace redbee
