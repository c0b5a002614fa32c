#include "redbee/detection/image_check.hpp"

#include "redbee/imaging/repeated_image.hpp"

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

ImageContent ImageCheck::classify(const cv::Mat1b& grey, int downscale) const {
  if (grey.empty()) return ImageContent::kUnusable;
  cv::Scalar mean, deviation;
  cv::meanStdDev(grey, mean, deviation);
  if (deviation[0] < min_contrast_) return ImageContent::kUnusable;
  if (repeats(grey, reference_, downscale)) {
    const bool is_same = cv::norm(reference_, grey, cv::NORM_INF) == 0;
    return is_same ? ImageContent::kFrozen : ImageContent::kRepeated;
  }
  const bool is_noise = grey.cols >= 2 && deviation[0] > 0 && roughness(grey, deviation[0]) >= kMaxRoughness;
  return is_noise ? ImageContent::kUnusable : ImageContent::kNew;
}

}  // namespace redbee
