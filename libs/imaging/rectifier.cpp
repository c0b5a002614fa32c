#include "redbee/imaging/rectifier.hpp"

#include <opencv2/imgproc.hpp>

namespace redbee {
namespace {

template <typename Mapping>
void tabulate(const Camera& camera, const Mapping& mapping, cv::Mat& map_1, cv::Mat& map_2) {
  const auto& size = camera.intrinsics();
  cv::Mat map(size.height, size.width, CV_32FC2);
  for (int v = 0; v < size.height; ++v) {
    for (int u = 0; u < size.width; ++u) {
      const Eigen::Vector2d source = mapping(Eigen::Vector2d(u, v));
      map.at<cv::Vec2f>(v, u) = {static_cast<float>(source.x()), static_cast<float>(source.y())};
    }
  }
  cv::convertMaps(map, cv::noArray(), map_1, map_2, CV_16SC2);
}

}  // namespace

Rectifier::Rectifier(const Camera& camera) {
  if (!camera.isDistorted()) return;
  tabulate(
      camera, [&](const Eigen::Vector2d& ideal) { return camera.distort(ideal); }, to_ideal_1_, to_ideal_2_);
  tabulate(
      camera, [&](const Eigen::Vector2d& raw) { return camera.undistort(raw); }, to_raw_1_, to_raw_2_);
  const cv::Mat white(camera.intrinsics().height, camera.intrinsics().width, CV_8U, cv::Scalar(255));
  cv::remap(white, seen_, to_ideal_1_, to_ideal_2_, cv::INTER_NEAREST);
}

cv::Mat Rectifier::toIdeal(const cv::Mat& raw) const {
  if (to_ideal_1_.empty()) return raw;
  cv::Mat ideal;
  cv::remap(raw, ideal, to_ideal_1_, to_ideal_2_, cv::INTER_LINEAR);
  return ideal;
}

cv::Mat Rectifier::toRaw(const cv::Mat& ideal) const {
  if (to_raw_1_.empty()) return ideal;
  cv::Mat raw;
  cv::remap(ideal, raw, to_raw_1_, to_raw_2_, cv::INTER_NEAREST);
  return raw;
}

}  // namespace redbee
