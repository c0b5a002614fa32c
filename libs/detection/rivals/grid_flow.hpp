// Tracks points on a regular grid from one image to the next by OpenCV's pyramidal Lucas-Kanade.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace redbee {

/// Defaults: those of the authors' code of mcd (Yi et al. 2013).
struct GridFlowParameters {
  cv::Size grid_px{32, 24};          ///< px between points
  int window_px = 10;                ///< px, side of the patch
  int levels = 3;                    ///< pyramid levels above the image itself
  int iterations = 20;               ///< at most, per level
  double epsilon_px = 0.03;          ///< px: a smaller step ends the iteration
  double min_eigenvalue = 1e-4;      ///< OpenCV's measure of texture, per pixel
  double max_there_and_back_px = 0;  ///< px: limit of the forward-backward error; 0: not checked
};

/// Correspondences, px.
struct GridTracks {
  std::vector<cv::Point2f> previous, current;
  size_t sampled = 0;  ///< grid points, including lost ones
};

class GridFlow {
 public:
  explicit GridFlow(const GridFlowParameters& parameters) : parameters_(parameters) {}

  void reset() { pyramid_.clear(); }
  bool hasPrevious() const { return !pyramid_.empty(); }
  /// Tracks the grid of the previous image into this one, which becomes the previous. All images between
  /// resets have the same size. Empty for the first.
  GridTracks advance(const cv::Mat1b& grey);
  /// Tracks the given points instead; `lost[i]` is not 0 for points that were not found.
  std::vector<cv::Point2f> follow(const cv::Mat1b& grey, const std::vector<cv::Point2f>& points,
                                  std::vector<uint8_t>& lost);

 private:
  std::vector<cv::Mat> pyramidOf(const cv::Mat1b& grey) const;
  std::vector<cv::Point2f> flow(const std::vector<cv::Mat>& from, const std::vector<cv::Mat>& to,
                                const std::vector<cv::Point2f>& points, std::vector<uint8_t>& found) const;

  GridFlowParameters parameters_;
  std::vector<cv::Mat> pyramid_;  ///< of the previous image
};

/// Centres of the cells of a grid over an image.
std::vector<cv::Point2f> gridPoints(cv::Size image, cv::Size cell_px);

}  // namespace redbee
