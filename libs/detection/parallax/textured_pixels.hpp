// The texture of an image where points are followed and where others may begin, in one pass over its
// structure tensor, of which no more than a row is kept.
#pragma once

#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "redbee/detection/parallax/structure_tensor.hpp"

namespace redbee {

class TexturedPixels {
 public:
  /// `window_px`: of the structure tensor. `least`: of its smaller eigenvalue where a point may begin.
  TexturedPixels(int window_px, int cell_px, float least)
      : window_px_(window_px), cell_px_(cell_px), least_(least) {}

  /// `points`: pixels of the image.
  void find(const cv::Mat1b& grey, const std::vector<cv::Point>& points);

  /// Around each of the points.
  const std::vector<Symmetric2f>& atPoints() const { return at_points_; }
  /// The best of each whole cell that holds no point, cell by cell from the top left.
  const std::vector<cv::Point>& best() const { return best_; }

 private:
  struct Cell {
    bool is_taken;
    float eigenvalue;  ///< the largest so far
    cv::Point at;      ///< x < 0: none
  };
  void sortPoints(int rows, const std::vector<cv::Point>& points);
  void searchRow(int y, const Symmetric2f* tensors);

  int window_px_, cell_px_;
  float least_;
  int cells_across_ = 0;
  std::vector<Cell> cells_;
  std::vector<int32_t> first_in_row_, next_in_row_;  ///< indices of points; -1: none
  std::vector<Symmetric2f> at_points_;
  std::vector<cv::Point> best_;
};

}  // namespace redbee
