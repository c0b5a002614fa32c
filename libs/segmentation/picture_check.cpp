#include "segmentation/picture_check.hpp"

namespace redbee {

bool PictureCheck::accepts(const cv::Mat& grey) {
  if (grey.empty()) return false;
  const bool frozen = previous_.size() == grey.size() && cv::norm(previous_, grey, cv::NORM_INF) == 0;
  previous_ = grey.clone();
  cv::Scalar mean, deviation;
  cv::meanStdDev(grey, mean, deviation);
  return !frozen && deviation[0] >= min_contrast_;
}

}  // namespace redbee
