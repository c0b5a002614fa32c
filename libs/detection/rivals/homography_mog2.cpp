#include "redbee/detection/rivals/homography_mog2.hpp"

#include <opencv2/imgproc.hpp>

#include "redbee/detection/rivals/graded_score.hpp"
#include "redbee/detection/rivals/stabilise.hpp"

namespace redbee {
namespace {

constexpr int kHistory = 100;         // frames; OpenCV's default of 500 is longer than a view lasts
constexpr double kVarThreshold = 16;  // OpenCV's default
constexpr double kMinOverlap = 0.6;
constexpr int kLearningFrames = 5;
constexpr float kDifferenceUnit = 30;  // grey levels: what is halfway up within either side of the decision
constexpr int kAveragePx = 15;
constexpr float kDecisionFraction = 0.38F;
constexpr uint8_t kMog2Foreground = 255;

double overlap(const cv::Matx33d& H, cv::Size size) {
  const cv::Mat unseen = unseenBy(H, size);
  return 1.0 - static_cast<double>(cv::countNonZero(unseen)) / static_cast<double>(unseen.total());
}

/// Largest of the channels' absolute differences.
cv::Mat greatestDifference(const cv::Mat& a, const cv::Mat& b) {
  cv::Mat difference;
  cv::absdiff(a, b, difference);
  std::vector<cv::Mat> channels;
  cv::split(difference, channels);
  return cv::max(cv::max(channels[0], channels[1]), channels[2]);
}

cv::Mat grade(const cv::Mat& mask, const cv::Mat& difference) {
  cv::Mat statistic;
  difference.convertTo(statistic, CV_32F);
  cv::Mat half;
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

void HomographyMog2::anchorHere(const cv::Mat& background) {
  model_ = cv::createBackgroundSubtractorMOG2(kHistory, kVarThreshold, true);
  anchor_ = cv::Matx33d::eye();
  cv::Mat mask;
  model_->apply(background, mask);
}

cv::Mat HomographyMog2::learn(const cv::Mat& image) {
  cv::Mat background;
  model_->getBackgroundImage(background);
  const cv::Mat unseen = unseenBy(anchor_.inv(), image.size());
  cv::Mat laid = stabilise(image, anchor_.inv());
  background.copyTo(laid, unseen);
  cv::Mat mask;
  model_->apply(laid, mask);
  mask.setTo(0, unseen);
  return stabilise(grade(mask, greatestDifference(laid, background)), anchor_, cv::INTER_NEAREST);
}

RivalOutput HomographyMog2::judge(const RivalInput& input) {
  RivalOutput output;
  const bool first = !registrar_.hasPrevious();
  const auto registration = registrar_.advance(input.grey);
  if (first) {
    anchorHere(input.colour);
    return output;
  }
  if (!registration) {
    output.status = RivalStatus::kLost;
    return output;
  }
  anchor_ = *registration * anchor_;
  if (overlap(anchor_, input.grey.size()) < kMinOverlap) {
    cv::Mat background;
    model_->getBackgroundImage(background);
    cv::Mat here = stabilise(background, anchor_);
    input.colour.copyTo(here, unseenBy(anchor_, here.size()));
    anchorHere(here);
  }
  output.score = averagedScore(learn(input.colour), kAveragePx, kDecisionFraction);
  output.background = *registration;
  output.status = ++learned_ < kLearningFrames ? RivalStatus::kLearning : RivalStatus::kGood;
  return output;
}

}  // namespace redbee
