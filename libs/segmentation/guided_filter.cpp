#include "segmentation/guided_filter.hpp"

#include <opencv2/imgproc.hpp>

namespace redbee {

cv::Mat guidedFilter(const cv::Mat& guide, const cv::Mat& map, int radius_px, double contrast) {
  const cv::Size window(2 * radius_px + 1, 2 * radius_px + 1);
  const auto mean = [&](const cv::Mat& of) {
    cv::Mat blurred;
    cv::blur(of, blurred, window);
    return blurred;
  };
  cv::Mat grey;
  guide.convertTo(grey, CV_32F);
  const cv::Mat mean_grey = mean(grey);
  const cv::Mat mean_map = mean(map);
  const cv::Mat variance = mean(grey.mul(grey)) - mean_grey.mul(mean_grey);
  const cv::Mat covariance = mean(grey.mul(map)) - mean_grey.mul(mean_map);
  const cv::Mat slope = covariance / (variance + contrast * contrast);
  const cv::Mat offset = mean_map - slope.mul(mean_grey);
  return mean(slope).mul(grey) + mean(offset);
}

}  // namespace redbee
