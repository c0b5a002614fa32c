// Points on a regular grid followed from one image into the next by OpenCV's pyramidal Lucas-Kanade.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace redbee {

/// Defaults: those of the public code of mcd (Yi et al. 2013).
struct GridFlowParameters {
  cv::Size grid_px{32, 24};          ///< px between points
  int window_px = 10;                ///< px, side of the patch
  int levels = 3;                    ///< pyramid levels above the image itself
  int iterations = 20;               ///< at most, per level
  double epsilon_px = 0.03;          ///< px: a smaller step ends the iteration
  double min_eigenvalue = 1e-4;      ///< OpenCV's measure of texture, per pixel
  double max_there_and_back_px = 0;  ///< px: a point followed there and back returns this close; 0: unchecked
};

/// Correspondences, px.
struct GridTracks {
  std::vector<cv::Point2f> previous, current;
  size_t sampled = 0;  ///< grid points, the lost ones included
};

class GridFlow {
 public:
  explicit GridFlow(const GridFlowParameters& parameters) : parameters_(parameters) {}

  void reset() { pyramid_.clear(); }
  bool hasPrevious() const { return !pyramid_.empty(); }
  /// Follows the grid of the image before into this one, which is then the one before. All images
  /// between resets are of one size. Empty for the first.
  GridTracks advance(const cv::Mat1b& grey);
  /// Follows any points instead; `lost[i]` tells which were not found.
  std::vector<cv::Point2f> follow(const cv::Mat1b& grey, const std::vector<cv::Point2f>& points,
                                  std::vector<uint8_t>& lost);

 private:
  std::vector<cv::Mat> pyramidOf(const cv::Mat1b& grey) const;
  std::vector<cv::Point2f> flow(const std::vector<cv::Mat>& from, const std::vector<cv::Mat>& to,
                                const std::vector<cv::Point2f>& points, std::vector<uint8_t>& found) const;

  GridFlowParameters parameters_;
  std::vector<cv::Mat> pyramid_;  ///< of the previous image
};

/// Centres of the cells of a grid over a image.
std::vector<cv::Point2f> gridPoints(cv::Size image, cv::Size cell_px);

}  // namespace redbee
