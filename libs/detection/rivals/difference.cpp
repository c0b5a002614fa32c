#include "redbee/detection/rivals/difference.hpp"

#include <opencv2/imgproc.hpp>

#include "redbee/detection/rivals/graded_score.hpp"
#include "redbee/imaging/warping.hpp"

namespace redbee {
namespace {

constexpr int kSmoothPx = 5;
constexpr float kThreshold = 20;  // grey levels

}  // namespace

Difference::Difference(const ObjectParameters& objects, const DifferenceParameters& parameters)
    : Rival(objects), parameters_(parameters), history_(parameters.back_frames) {}

void Difference::reset() {
  registrar_.reset();
  history_.clear();
}

RivalScore Difference::scoreFrame(const FrameInput& input) {
  RivalScore scored;
  const bool first = !registrar_.hasPrevious();
  const auto registration = registrar_.advance(input.grey);
  cv::Mat1b smooth;
  cv::GaussianBlur(input.grey, smooth, {kSmoothPx, kSmoothPx}, 0);
  if (registration) {
    scored.status = DetectorStatus::kGood;
    scored.background = *registration;
    cv::Mat difference;
    history_.propagate(*registration);
    cv::absdiff(smooth, warpToCurrent(history_.oldest(), history_.oldestToNewest(), cv::INTER_LINEAR),
                difference);
    difference.setTo(0, outsidePrevious(history_.oldestToNewest(), smooth.size()));
    difference.convertTo(difference, CV_32F);
    cv::blur(difference, difference, {parameters_.average_px, parameters_.average_px});
    scored.score = gradedScore(difference, kThreshold);
  } else if (!first) {
    scored.status = DetectorStatus::kNoHomography;
  }
  history_.push(smooth);
  return scored;
}

}  // namespace redbee
