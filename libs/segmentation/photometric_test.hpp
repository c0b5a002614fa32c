// What the grey values say about a motion that the flow claims.
#pragma once

#include <opencv2/core.hpp>

#include "segmentation/parameters.hpp"

namespace redbee {

/// Weight 0..1 (CV_32F) of the claim that a pixel moved by itself. `picture`: the current one (CV_8U);
/// `as_static`, `as_moving`: the earlier picture as the current one would look if the pixel stood still at
/// its likeliest depth, and if it followed the free flow. Two questions, multiplied:
/// - does moving fit better than standing still, over a wide window? (Where there is no texture it cannot,
/// and there flow
///   means nothing.)
/// - is there a difference to standing still at all, over a narrow one? (This gives the silhouette; flow
/// alone is fat.)
cv::Mat photometricWeight(const cv::Mat& picture, const cv::Mat& as_static, const cv::Mat& as_moving,
                          const SegmentationParameters& parameters);

}  // namespace redbee
