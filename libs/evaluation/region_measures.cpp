#include "redbee/evaluation/region_measures.hpp"

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "redbee/evaluation/truth_label.hpp"

namespace redbee {
namespace {

constexpr double kContourTolerance = 0.008;  // of the image's diagonal

/// Pixels whose right, lower or lower right neighbour lies on the other side, as DAVIS' seg2bmap has them.
cv::Mat1b contourOf(const cv::Mat1b& region) {
  const cv::Mat1b inside = region != 0;
  cv::Mat1b padded;
  cv::copyMakeBorder(inside, padded, 0, 1, 0, 1, cv::BORDER_REPLICATE);
  const auto shifted = [&](int x, int y) { return padded(cv::Rect(x, y, region.cols, region.rows)); };
  return (inside ^ shifted(1, 0)) | (inside ^ shifted(0, 1)) | (inside ^ shifted(1, 1));
}

cv::Mat1b grown(const cv::Mat1b& contour) {
  const int radius = static_cast<int>(std::ceil(kContourTolerance * std::hypot(contour.cols, contour.rows)));
  cv::Mat1b disc(2 * radius + 1, 2 * radius + 1);
  for (int y = -radius; y <= radius; ++y) {
    for (int x = -radius; x <= radius; ++x)
      disc(y + radius, x + radius) = x * x + y * y <= radius * radius ? 1 : 0;
  }
  cv::Mat1b result;
  cv::dilate(contour, result, disc);
  return result;
}

}  // namespace

double regionSimilarity(const cv::Mat1b& mask, const cv::Mat1b& truth) {
  const int either = cv::countNonZero(mask | truth);
  return either == 0 ? 1 : static_cast<double>(cv::countNonZero(mask & truth)) / either;
}

double contourAccuracy(const cv::Mat1b& mask, const cv::Mat1b& truth) {
  const cv::Mat1b found = contourOf(mask), expected = contourOf(truth);
  const double found_px = cv::countNonZero(found), expected_px = cv::countNonZero(expected);
  if (found_px == 0 && expected_px == 0) return 1;
  if (found_px == 0 || expected_px == 0) return 0;
  const double precision = cv::countNonZero(found & grown(expected)) / found_px;
  const double recall = cv::countNonZero(expected & grown(found)) / expected_px;
  return precision + recall > 0 ? 2 * precision * recall / (precision + recall) : 0;
}

void RegionMeasures::add(const cv::Mat1b& mask, const cv::Mat1b& labels) {
  if (mask.size() != labels.size()) throw std::invalid_argument("RegionMeasures: maps of different sizes");
  const cv::Mat1b truth = labels == kTruthMoving;
  const cv::Mat1b known_mask = (mask != 0) & (truth | (labels == kTruthStatic));
  j_sum_ += regionSimilarity(known_mask, truth);
  f_sum_ += contourAccuracy(known_mask, truth);
  ++frames_;
}

}  // namespace redbee
