// Pictures and maps moved by homographies.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

namespace redbee {

cv::Matx33d toMatx(const Eigen::Matrix3d& H);

/// The map as the current frame sees it: out(x) = map(H^-1 x), H previous to current. 0 where the map does
/// not reach. `interpolation` is one of OpenCV's.
cv::Mat carryMap(const cv::Mat& map, const Eigen::Matrix3d& H, int interpolation);

/// 255 where H^-1 takes a current pixel into the previous picture, else 0.
cv::Mat overlapMask(const cv::Size& size, const Eigen::Matrix3d& H);

/// True where H is finite and can be inverted.
bool isUsableHomography(const Eigen::Matrix3d& H);

}  // namespace redbee
