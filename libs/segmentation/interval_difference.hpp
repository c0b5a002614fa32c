// How far a picture is from what a static scene would look like, whatever a pixel of registration error does.
#pragma once

#include <opencv2/core.hpp>

namespace redbee {

/// Least and largest grey value within a pixel's reach (CV_8U): a static point registered that badly lies
/// between them (after Birchfield and Tomasi 1998).
struct GreyInterval {
  GreyInterval(const cv::Mat& grey, int reach_px);
  /// The interval around the pixels that `source` (CV_32FC2) names.
  GreyInterval at(const cv::Mat& source) const;
  /// Grey levels by which `picture` lies outside, CV_8U.
  cv::Mat outside(const cv::Mat& picture) const;

  cv::Mat low, high;

 private:
  GreyInterval() = default;
};

/// d^2 / (d^2 + noise^2) of the difference averaged over window_px, CV_32F 0..1.
cv::Mat differenceEvidence(const cv::Mat& difference, int window_px, double noise);

}  // namespace redbee
