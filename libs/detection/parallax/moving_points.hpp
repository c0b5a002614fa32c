// Points whose path no static surface explains, and the pixels around them that belong to the same object.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "redbee/detection/parallax/point_paths.hpp"

namespace redbee {

/// Those that move beyond doubt: their path contradicts every static point by more than the frame's own
/// clutter, a steady motion explains it, and they are not alone. Two neighbours at least move alike, and half
/// of the tested points around (a junction of a near edge and a far one moves unlike both, among points that
/// rest). `scale`: full-size pixels per pixel of the paths'.
std::vector<cv::Point> movingPoints(const std::vector<PointPath>& paths, double scale);

/// 0..1, of the paths' images: where the appearance differs from the background (29) about as much as at a
/// moving point next to it; empty without points. Points in cast shadows, which differ little, count little.
/// `difference`: 0..1, of any size; `size`: of the paths' images.
cv::Mat1f movingRegion(const std::vector<cv::Point>& points, const cv::Mat1f& difference, cv::Size size,
                       double scale);

}  // namespace redbee
