#include "redbee/detection/parallax/textured_pixels.hpp"

#include <utility>

namespace redbee {

void TexturedPixels::sortPoints(int rows, const std::vector<cv::Point>& points) {
  first_in_row_.assign(static_cast<size_t>(rows), -1);
  next_in_row_.resize(points.size());
  at_points_.resize(points.size());
  for (size_t i = 0; i < points.size(); ++i)
    next_in_row_[i] = std::exchange(first_in_row_[static_cast<size_t>(points[i].y)], static_cast<int32_t>(i));
}

void TexturedPixels::searchRow(int y, const Symmetric2f* tensors) {
  Cell* const cells = &cells_[static_cast<size_t>(y / cell_px_ * cells_across_)];
  for (int column = 0; column < cells_across_; ++column) {
    Cell& cell = cells[column];
    if (cell.is_taken) continue;
    for (int x = column * cell_px_; x < (column + 1) * cell_px_; ++x) {
      const Symmetric2f& S = tensors[x];
      if (0.5F * (S[0] + S[2]) <= cell.eigenvalue) continue;  // the mean is cheap
      const float eigenvalue = smallestEigenvalue(S);
      if (eigenvalue <= cell.eigenvalue) continue;
      cell.eigenvalue = eigenvalue;
      cell.at = {x, y};
    }
  }
}

void TexturedPixels::find(const cv::Mat1b& grey, const std::vector<cv::Point>& points) {
  cells_across_ = grey.cols / cell_px_;
  const int cells_down = grey.rows / cell_px_;
  cells_.assign(static_cast<size_t>(cells_across_ * cells_down), {false, least_, {-1, -1}});
  for (const cv::Point& at : points) {
    const int column = at.x / cell_px_, row = at.y / cell_px_;
    if (column < cells_across_ && row < cells_down)
      cells_[static_cast<size_t>(row * cells_across_ + column)].is_taken = true;
  }
  sortPoints(grey.rows, points);
  forEachTensorRow(grey, window_px_, [&](int y, const Symmetric2f* tensors) {
    for (int32_t i = first_in_row_[static_cast<size_t>(y)]; i >= 0; i = next_in_row_[static_cast<size_t>(i)])
      at_points_[static_cast<size_t>(i)] = tensors[points[static_cast<size_t>(i)].x];
    if (y < cells_down * cell_px_) searchRow(y, tensors);
  });
  best_.clear();
  for (const Cell& cell : cells_) {
    if (cell.at.x >= 0) best_.push_back(cell.at);
  }
}

}  // namespace redbee
