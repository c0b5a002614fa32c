// Connected regions of a mask, for the components of the foreground.
#pragma once

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace redbee {

/// For morphology.
inline cv::Mat1b disc(int diameter) {
  return cv::getStructuringElement(cv::MORPH_ELLIPSE, {diameter, diameter});
}

/// Calls work(box, area, pixels of the region in the box) for each connected region that is large enough.
template <typename Work>
void forEachRegion(const cv::Mat1b& mask, double min_area_px, const Work& work) {
  cv::Mat1i labels, statistics;
  cv::Mat1d centroids;
  const int count = cv::connectedComponentsWithStats(mask, labels, statistics, centroids, 8, CV_32S);
  for (int label = 1; label < count; ++label) {
    const int* row = statistics[label];
    if (row[cv::CC_STAT_AREA] < min_area_px) continue;
    const cv::Rect box(row[cv::CC_STAT_LEFT], row[cv::CC_STAT_TOP], row[cv::CC_STAT_WIDTH],
                       row[cv::CC_STAT_HEIGHT]);
    work(box, row[cv::CC_STAT_AREA], cv::Mat1b(labels(box) == label));
  }
}

/// Mean of a map, of any size, around a box of an image of size `image`: as far as the box's longer side,
/// beyond what the object's own flow reaches. 1 if nothing is known there.
double meanAround(const cv::Mat1f& map, cv::Size image, const cv::Rect& box);

}  // namespace redbee
