#include "redbee/imaging/rectifier.hpp"

#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace redbee {
namespace {

/// Source coordinate of pixels without a source: outside every image, but within the range of the fixed-point
/// tables.
constexpr float kNowhere = -16384;

/// Source pixel of every pixel of an image of `size`.
template <typename Mapping>
void tabulate(const CameraIntrinsics& size, const Mapping& mapping, cv::Mat& map_1, cv::Mat& map_2) {
  cv::Mat map(size.height, size.width, CV_32FC2);
  for (int v = 0; v < size.height; ++v) {
    for (int u = 0; u < size.width; ++u) {
      const std::optional<Eigen::Vector2d> source = mapping(Eigen::Vector2d(u, v));
      map.at<cv::Vec2f>(v, u) =
          source ? cv::Vec2f(static_cast<float>(source->x()), static_cast<float>(source->y()))
                 : cv::Vec2f(kNowhere, kNowhere);
    }
  }
  cv::convertMaps(map, cv::noArray(), map_1, map_2, CV_16SC2);
}

}  // namespace

Rectifier::Rectifier(const Camera& camera, const cv::Mat1b& own_parts) {
  const cv::Size raw_size(camera.intrinsics().width, camera.intrinsics().height);
  if (!own_parts.empty() && own_parts.size() != raw_size)
    throw std::invalid_argument("the mask of the vehicle's own parts has another size than the images");
  if (!camera.isDistorted()) {
    own_parts_ = unknown_ = own_parts.clone();
    return;
  }
  const auto distort = [&](const Eigen::Vector2d& ideal) { return camera.distort(ideal); };
  const auto undistort = [&](const Eigen::Vector2d& raw) { return camera.undistort(raw); };
  tabulate(camera.ideal(), distort, to_ideal_1_, to_ideal_2_);
  tabulate(camera.intrinsics(), undistort, to_raw_1_, to_raw_2_);
  const cv::Mat shown(raw_size, CV_8U, cv::Scalar(0));
  cv::remap(shown, unknown_, to_ideal_1_, to_ideal_2_, cv::INTER_NEAREST, cv::BORDER_CONSTANT, 255);
  if (cv::countNonZero(unknown_) == 0) unknown_.release();
  if (own_parts.empty()) return;
  cv::remap(own_parts, own_parts_, to_ideal_1_, to_ideal_2_, cv::INTER_NEAREST, cv::BORDER_CONSTANT, 0);
  unknown_ = unknown_.empty() ? own_parts_.clone() : cv::Mat1b(unknown_ | own_parts_);
}

cv::Mat Rectifier::toIdeal(const cv::Mat& raw) const {
  if (to_ideal_1_.empty()) return raw;
  cv::Mat ideal;
  cv::remap(raw, ideal, to_ideal_1_, to_ideal_2_, cv::INTER_LINEAR);
  return ideal;
}

cv::Mat1b Rectifier::toRaw(const cv::Mat1b& ideal, uchar outside) const {
  if (to_raw_1_.empty()) return ideal;
  cv::Mat1b raw;
  cv::remap(ideal, raw, to_raw_1_, to_raw_2_, cv::INTER_NEAREST, cv::BORDER_CONSTANT, outside);
  return raw;
}

}  // namespace redbee
