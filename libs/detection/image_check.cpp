#include "redbee/detection/image_check.hpp"

namespace redbee {
namespace {

/// Correlation measure of neighbouring pixels in a row: 1 for independent pixels, a few hundredths for images
/// of a scene.
constexpr double kMaxRoughness = 0.7;

/// Mean squared difference of neighbours over its value for independent pixels, twice the variance.
double roughness(const cv::Mat1b& grey, double deviation) {
  cv::Mat1b difference;
  cv::absdiff(grey.colRange(1, grey.cols), grey.colRange(0, grey.cols - 1), difference);
  const double squares = cv::norm(difference, cv::NORM_L2SQR);
  return squares / static_cast<double>(difference.total()) / (2 * deviation * deviation);
}

}  // namespace

bool ImageCheck::accepts(const cv::Mat1b& grey) {
  if (grey.empty()) {
    previous_.release();
    return false;
  }
  const bool frozen = previous_.size() == grey.size() && cv::norm(previous_, grey, cv::NORM_INF) == 0;
  previous_ = grey.clone();
  cv::Scalar mean, deviation;
  cv::meanStdDev(grey, mean, deviation);
  if (frozen || deviation[0] < min_contrast_) return false;
  return grey.cols < 2 || deviation[0] == 0 || roughness(grey, deviation[0]) < kMaxRoughness;
}

}  // namespace redbee
