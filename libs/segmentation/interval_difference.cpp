#include "segmentation/interval_difference.hpp"

#include <opencv2/imgproc.hpp>

namespace redbee {

GreyInterval::GreyInterval(const cv::Mat& grey, int reach_px) {
  const int side = 2 * reach_px + 1;
  const cv::Mat square = cv::getStructuringElement(cv::MORPH_RECT, {side, side});
  cv::erode(grey, low, square);
  cv::dilate(grey, high, square);
}

GreyInterval GreyInterval::at(const cv::Mat& source) const {
  GreyInterval there;
  cv::remap(low, there.low, source, {}, cv::INTER_NEAREST, cv::BORDER_REPLICATE);
  cv::remap(high, there.high, source, {}, cv::INTER_NEAREST, cv::BORDER_REPLICATE);
  return there;
}

cv::Mat GreyInterval::outside(const cv::Mat& picture) const {
  // Subtraction of bytes stops at 0, so the two never both count.
  cv::Mat above, below;
  cv::subtract(picture, high, above);
  cv::subtract(low, picture, below);
  return cv::max(above, below);
}

cv::Mat differenceEvidence(const cv::Mat& difference, int window_px, double noise) {
  cv::Mat mean;
  cv::boxFilter(difference, mean, CV_32F, {window_px, window_px});
  const auto noise2 = static_cast<float>(noise * noise);
  for (int y = 0; y < mean.rows; ++y) {
    float* row = mean.ptr<float>(y);
    for (int x = 0; x < mean.cols; ++x) row[x] = row[x] * row[x] / (row[x] * row[x] + noise2);
  }
  return mean;
}

}  // namespace redbee
