#include "redbee/detection/rivals/grid_flow.hpp"

#include <opencv2/video/tracking.hpp>
#include <utility>

namespace redbee {

std::vector<cv::Point2f> gridPoints(cv::Size image, cv::Size cell_px) {
  std::vector<cv::Point2f> points;
  for (int y = cell_px.height / 2; y < image.height; y += cell_px.height) {
    for (int x = cell_px.width / 2; x < image.width; x += cell_px.width) {
      points.emplace_back(static_cast<float>(x), static_cast<float>(y));
    }
  }
  return points;
}

std::vector<cv::Mat> GridFlow::pyramidOf(const cv::Mat1b& grey) const {
  std::vector<cv::Mat> pyramid;
  cv::buildOpticalFlowPyramid(grey, pyramid, {parameters_.window_px, parameters_.window_px},
                              parameters_.levels);
  return pyramid;
}

std::vector<cv::Point2f> GridFlow::flow(const std::vector<cv::Mat>& from, const std::vector<cv::Mat>& to,
                                        const std::vector<cv::Point2f>& points,
                                        std::vector<uint8_t>& found) const {
  std::vector<cv::Point2f> moved;
  cv::calcOpticalFlowPyrLK(
      from, to, points, moved, found, cv::noArray(), {parameters_.window_px, parameters_.window_px},
      parameters_.levels,
      {cv::TermCriteria::COUNT | cv::TermCriteria::EPS, parameters_.iterations, parameters_.epsilon_px}, 0,
      parameters_.min_eigenvalue);
  return moved;
}

std::vector<cv::Point2f> GridFlow::follow(const cv::Mat1b& grey, const std::vector<cv::Point2f>& points,
                                          std::vector<uint8_t>& lost) {
  const std::vector<cv::Mat> before = std::exchange(pyramid_, pyramidOf(grey));
  lost.assign(points.size(), 1);
  if (before.empty() || points.empty()) return points;
  std::vector<uint8_t> found;
  std::vector<cv::Point2f> moved = flow(before, pyramid_, points, found);
  std::vector<cv::Point2f> returned = points;
  std::vector<uint8_t> found_back(points.size(), 1);
  if (parameters_.max_there_and_back_px > 0) returned = flow(pyramid_, before, moved, found_back);
  const cv::Rect2f image({}, cv::Size2f(grey.size()));
  for (size_t i = 0; i < points.size(); ++i) {
    const bool returns = cv::norm(returned[i] - points[i]) <= parameters_.max_there_and_back_px;
    lost[i] = found[i] != 0 && found_back[i] != 0 && returns && image.contains(moved[i]) ? 0 : 1;
  }
  return moved;
}

GridTracks GridFlow::advance(const cv::Mat1b& grey) {
  const bool first = !hasPrevious();
  const std::vector<cv::Point2f> grid = gridPoints(grey.size(), parameters_.grid_px);
  std::vector<uint8_t> lost;
  const std::vector<cv::Point2f> moved = follow(grey, grid, lost);
  GridTracks tracks;
  tracks.sampled = first ? 0 : grid.size();
  for (size_t i = 0; i < grid.size(); ++i) {
    if (lost[i] != 0) continue;
    tracks.previous.push_back(grid[i]);
    tracks.current.push_back(moved[i]);
  }
  return tracks;
}

}  // namespace redbee
