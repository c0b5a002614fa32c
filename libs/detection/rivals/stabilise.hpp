// Images warped into the current frame.
#pragma once

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace redbee {

/// An image or a map of any depth, warped into the current frame; `H` previous to current. 0 where it does
/// not reach.
inline cv::Mat stabilise(const cv::Mat& previous, const cv::Matx33d& H,
                         int interpolation = cv::INTER_LINEAR) {
  cv::Mat stabilised;
  cv::warpPerspective(previous, stabilised, H, previous.size(), interpolation);
  return stabilised;
}

/// 255 where a current pixel, or a neighbour of it, was outside of the previous image, else 0.
inline cv::Mat unseenBy(const cv::Matx33d& H, cv::Size size) {
  const cv::Mat seen = stabilise(cv::Mat(size, CV_8U, cv::Scalar(255)), H, cv::INTER_NEAREST);
  cv::Mat unseen;
  cv::dilate(seen == 0, unseen, cv::Mat());
  return unseen;
}

}  // namespace redbee
