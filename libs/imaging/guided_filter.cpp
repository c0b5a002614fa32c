#include "redbee/imaging/guided_filter.hpp"

#include <algorithm>
#include <cstdlib>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "redbee/imaging/guided_filter_kernels.hpp"
#include "redbee/imaging/resampled.hpp"

namespace redbee {
namespace {

/// cv::blur() with a window of `side` pixels, which the image holds both ways.
cv::Mat1f boxMean(const cv::Mat1f& of, int side) {
  cv::Mat1f mean(of.size());
  std::vector<double> sums(static_cast<size_t>(of.cols + side), 0.0);
  const auto mirrored = [&](int y) {
    const int row = std::abs(y);
    return of[std::min(row, 2 * (of.rows - 1) - row)];
  };
  const int radius = side / 2;
  for (int y = -2 * radius; y < of.rows; ++y) {
    const float* leaving = y > 0 ? mirrored(y - radius - 1) : nullptr;
    boxMeanRow({static_cast<size_t>(of.cols), side, mirrored(y + radius), leaving, sums.data(),
                y < 0 ? nullptr : mean[y]});
  }
  return mean;
}

cv::Mat1f product(const cv::Mat1f& a, const cv::Mat1f& b) {
  cv::Mat1f product;
  cv::multiply(a, b, product);
  return product;
}

}  // namespace

cv::Mat1f guidedFilter(const cv::Mat& guide, const cv::Mat1f& map, int radius_px, double contrast) {
  // Slope and offset are smooth, so they are computed at a lower resolution.
  const int shrink = std::clamp(radius_px / 2, 1, 4);
  const cv::Size small((guide.cols + shrink - 1) / shrink, (guide.rows + shrink - 1) / shrink);
  const int widest = (std::min(small.width, small.height) - 1) / 2;
  const int side = 2 * std::min(std::max(1, radius_px / shrink), widest) + 1;
  cv::Mat1f full_grey = guide;
  if (guide.depth() != CV_32F) guide.convertTo(full_grey, CV_32F);
  const cv::Mat1f grey = resized(full_grey, small, cv::INTER_AREA),
                  shrunk = resized(map, small, cv::INTER_AREA);
  const cv::Mat1f mean_grey = boxMean(grey, side), mean_map = boxMean(shrunk, side);
  const cv::Mat1f mean_square = boxMean(product(grey, grey), side);
  const cv::Mat1f mean_product = boxMean(product(grey, shrunk), side);
  cv::Mat1f slope(small), offset(small);
  for (int y = 0; y < small.height; ++y) {
    linearModelRow({static_cast<size_t>(small.width), mean_grey[y], mean_map[y], mean_square[y],
                    mean_product[y], slope[y], offset[y]},
                   static_cast<float>(contrast * contrast));
  }
  slope = resized(boxMean(slope, side), guide.size(), cv::INTER_LINEAR);
  offset = resized(boxMean(offset, side), guide.size(), cv::INTER_LINEAR);
  for (int y = 0; y < guide.rows; ++y) {
    applyModelRow(slope[y], offset[y], full_grey[y], static_cast<size_t>(guide.cols), slope[y]);
  }
  return slope;
}

}  // namespace redbee
