#include "redbee/detection/refinement/foreground_probability.hpp"

#include <opencv2/imgproc.hpp>

#include "redbee/imaging/warping.hpp"

namespace redbee {
namespace {

void follow(cv::Mat1f& map, const cv::Mat1f& value, double rate) {
  if (map.empty()) map = cv::Mat1f::zeros(value.size());
  cv::addWeighted(map, 1 - rate, value, rate, 0, map);
}

}  // namespace

void ForegroundProbability::reset() {
  temporal_.release();
  spatial_.release();
  entropy_.release();
}

void ForegroundProbability::propagate(const Eigen::Matrix3d& ground) {
  for (cv::Mat1f* map : {&temporal_, &spatial_, &entropy_}) {
    if (!map->empty()) *map = warpToCurrent(*map, ground, cv::INTER_LINEAR);
  }
}

cv::Mat1f ForegroundProbability::update(const cv::Mat1f& foreground, const cv::Mat1f& order) {
  cv::Mat1f neighbourhood;
  const cv::Size window(parameters_.spatial_window_px, parameters_.spatial_window_px);
  cv::boxFilter(foreground, neighbourhood, CV_32F, window, {-1, -1}, true, cv::BORDER_REPLICATE);
  follow(temporal_, foreground, parameters_.alpha);
  follow(spatial_, neighbourhood, parameters_.beta);
  cv::Mat1f probability = temporal_.mul(spatial_);
  if (!order.empty()) {
    follow(entropy_, order, parameters_.gamma);
    probability = probability.mul(entropy_);
  }
  return probability;
}

}  // namespace redbee
