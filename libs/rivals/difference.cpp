#include "rivals/difference.hpp"

#include <opencv2/imgproc.hpp>

#include "rivals/graded_score.hpp"
#include "rivals/stabilise.hpp"

namespace redbee {
namespace {

constexpr int kSmoothPx = 5;
constexpr float kThreshold = 20;  // grey levels

}  // namespace

void Difference::reset() {
  registrar_.reset();
  previous_.release();
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
    cv::absdiff(smooth, stabilise(previous_, *registration), difference);
    difference.setTo(0, unseenBy(*registration, smooth.size()));
    difference.convertTo(difference, CV_32F);
    output.score = gradedScore(difference, kThreshold);
  } else if (!first) {
    output.status = RivalStatus::kLost;
  }
  previous_ = smooth;
  return output;
}

}  // namespace redbee
