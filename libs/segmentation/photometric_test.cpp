#include "segmentation/photometric_test.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace redbee {
namespace {

cv::Mat squaredDifference(const cv::Mat& a, const cv::Mat& b) {
  cv::Mat difference;
  cv::absdiff(a, b, difference);
  difference.convertTo(difference, CV_32F);
  return difference.mul(difference);
}

cv::Mat windowMean(const cv::Mat& map, int side) {
  cv::Mat mean;
  cv::blur(map, mean, {side, side});
  return mean;
}

}  // namespace

cv::Mat photometricWeight(const cv::Mat& picture, const cv::Mat& as_static, const cv::Mat& as_moving,
                          const SegmentationParameters& parameters) {
  const cv::Mat off_static = squaredDifference(picture, as_static);
  const cv::Mat wide_static = windowMean(off_static, parameters.photometric_window_px);
  const cv::Mat wide_moving =
      windowMean(squaredDifference(picture, as_moving), parameters.photometric_window_px);
  const cv::Mat narrow_static = windowMean(off_static, parameters.silhouette_window_px);
  const float noise2 = static_cast<float>(parameters.photometric_noise * parameters.photometric_noise);
  cv::Mat weight(picture.size(), CV_32F);
  for (int y = 0; y < weight.rows; ++y) {
    const float* fixed = wide_static.ptr<float>(y);
    const float* moving = wide_moving.ptr<float>(y);
    const float* narrow = narrow_static.ptr<float>(y);
    float* out = weight.ptr<float>(y);
    for (int x = 0; x < weight.cols; ++x) {
      const float gain = std::max(0.0F, fixed[x] - moving[x]);
      out[x] = gain / (gain + moving[x] + noise2) * narrow[x] / (narrow[x] + noise2);
    }
  }
  return weight;
}

}  // namespace redbee
