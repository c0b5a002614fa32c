// Overlap of two boxes, in pixels.
#pragma once

#include <opencv2/core.hpp>

namespace redbee {

/// The box with a margin on all four sides.
inline cv::Rect2d grown(const cv::Rect2d& box, double margin) {
  return {box.x - margin, box.y - margin, box.width + 2 * margin, box.height + 2 * margin};
}

/// Intersection over union, 0 to 1; 0 for two empty boxes.
inline double intersectionOverUnion(const cv::Rect2d& a, const cv::Rect2d& b) {
  const double both = (a & b).area();
  const double all = a.area() + b.area() - both;
  return all > 0 ? both / all : 0;
}

/// Fraction of `box` inside `other`; 0 for an empty box.
inline double coveredFraction(const cv::Rect2d& box, const cv::Rect2d& other) {
  return box.area() > 0 ? (box & other).area() / box.area() : 0;
}

}  // namespace redbee
