#include "redbee/detection/rivals/difference.hpp"

#include <opencv2/imgproc.hpp>

#include "redbee/detection/rivals/graded_score.hpp"
#include "redbee/detection/rivals/stabilise.hpp"

namespace redbee {
namespace {

constexpr int kSmoothPx = 5;
constexpr float kThreshold = 20;  // grey levels

}  // namespace

Difference::Difference(const DifferenceParameters& parameters)
    : parameters_(parameters), history_(parameters.back_frames) {}

void Difference::reset() {
  registrar_.reset();
  history_.clear();
}

RivalOutput Difference::judge(const RivalInput& input) {
  RivalOutput output;
  const bool first = !registrar_.hasPrevious();
  const auto registration = registrar_.advance(input.grey);
  cv::Mat smooth;
  cv::GaussianBlur(input.grey, smooth, {kSmoothPx, kSmoothPx}, 0);
  if (registration) {
    output.status = RivalStatus::kGood;
    output.background = *registration;
    cv::Mat difference;
    history_.carry(*registration);
    cv::absdiff(smooth, stabilise(history_.oldest(), history_.oldestToNewest()), difference);
    difference.setTo(0, unseenBy(history_.oldestToNewest(), smooth.size()));
    difference.convertTo(difference, CV_32F);
    cv::blur(difference, difference, {parameters_.average_px, parameters_.average_px});
    output.score = gradedScore(difference, kThreshold);
  } else if (!first) {
    output.status = RivalStatus::kLost;
  }
  history_.push(smooth);
  return output;
}

}  // namespace redbee
