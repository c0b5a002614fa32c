#include "redbee/detection/two_planes/foreground_probability.hpp"

#include <opencv2/imgproc.hpp>

#include "redbee/imaging/warping.hpp"

namespace redbee {
namespace {

void follow(cv::Mat& map, const cv::Mat& value, double rate) {
  if (map.empty()) map = cv::Mat::zeros(value.size(), CV_32F);
  cv::addWeighted(map, 1 - rate, value, rate, 0, map);
}

}  // namespace

void ForegroundProbability::reset() {
  temporal_.release();
  spatial_.release();
  entropy_.release();
}

void ForegroundProbability::carry(const Eigen::Matrix3d& ground) {
  for (cv::Mat* map : {&temporal_, &spatial_, &entropy_}) {
    if (!map->empty()) *map = carryMap(*map, ground, cv::INTER_LINEAR);
  }
}

cv::Mat ForegroundProbability::update(const cv::Mat& foreground, const cv::Mat& order) {
  cv::Mat neighbourhood;
  const cv::Size window(parameters_.spatial_window_px, parameters_.spatial_window_px);
  cv::boxFilter(foreground, neighbourhood, CV_32F, window, {-1, -1}, true, cv::BORDER_REPLICATE);
  follow(temporal_, foreground, parameters_.alpha);
  follow(spatial_, neighbourhood, parameters_.beta);
  cv::Mat probability = temporal_.mul(spatial_);
  if (!order.empty()) {
    follow(entropy_, order, parameters_.gamma);
    probability = probability.mul(entropy_);
  }
  return probability;
}

}  // namespace redbee
