#include "redbee/imaging/guided_filter.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace redbee {

cv::Mat1f guidedFilter(const cv::Mat& guide, const cv::Mat1f& map, int radius_px, double contrast) {
  // Slope and offset are smooth, so they are computed at a lower resolution.
  const int shrink = std::clamp(radius_px / 2, 1, 4);
  const cv::Size small((guide.cols + shrink - 1) / shrink, (guide.rows + shrink - 1) / shrink);
  const int side = 2 * std::max(1, radius_px / shrink) + 1;
  const auto mean = [&](const cv::Mat1f& of) {
    cv::Mat1f blurred;
    cv::blur(of, blurred, {side, side});
    return blurred;
  };
  cv::Mat1f full_grey, grey, shrunk;
  guide.convertTo(full_grey, CV_32F);
  cv::resize(full_grey, grey, small, 0, 0, cv::INTER_AREA);
  cv::resize(map, shrunk, small, 0, 0, cv::INTER_AREA);
  const cv::Mat1f mean_grey = mean(grey);
  const cv::Mat1f mean_map = mean(shrunk);
  const cv::Mat1f variance = mean(grey.mul(grey)) - mean_grey.mul(mean_grey);
  const cv::Mat1f covariance = mean(grey.mul(shrunk)) - mean_grey.mul(mean_map);
  cv::Mat1f slope = covariance / (variance + contrast * contrast);
  cv::Mat1f offset = mean_map - slope.mul(mean_grey);
  cv::resize(mean(slope), slope, guide.size(), 0, 0, cv::INTER_LINEAR);
  cv::resize(mean(offset), offset, guide.size(), 0, 0, cv::INTER_LINEAR);
  return slope.mul(full_grey) + offset;
}

}  // namespace redbee
