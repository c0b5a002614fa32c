// Overlap of two boxes.
#pragma once

#include <opencv2/core.hpp>

namespace redbee {

/// Intersection over union, 0 to 1; 0 for two empty boxes.
inline double intersectionOverUnion(const cv::Rect2d& a, const cv::Rect2d& b) {
  const double both = (a & b).area();
  const double all = a.area() + b.area() - both;
  return all > 0 ? both / all : 0;
}

}  // namespace redbee
