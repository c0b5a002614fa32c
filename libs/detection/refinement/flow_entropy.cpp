#include "redbee/detection/refinement/flow_entropy.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "redbee/geometry/angle.hpp"
#include "redbee/geometry/homography.hpp"

namespace redbee {
namespace {

struct Cell {
  std::vector<int> histogram;
  int tracks = 0;
};

double order(const Cell& cell, const RefinementParameters& parameters) {
  if (cell.tracks == 0) return 1.0;
  const bool votes = std::any_of(cell.histogram.begin(), cell.histogram.end(), [](int n) { return n > 0; });
  const double entropy = votes ? histogramEntropy(cell.histogram) : std::log2(parameters.entropy_bins);
  return parameters.entropy_floor / std::max(entropy, parameters.entropy_floor);
}

int directionBin(const Eigen::Vector2d& flow, int bins) {
  const double turn = std::atan2(flow.y(), flow.x()) / (2 * kPi) + 0.5;
  return std::min(static_cast<int>(turn * bins), bins - 1);
}

}  // namespace

double histogramEntropy(const std::vector<int>& histogram) {
  double total = 0;
  for (const int count : histogram) total += count;
  double entropy = 0;
  for (const int count : histogram) {
    if (count > 0) entropy -= count / total * std::log2(count / total);
  }
  return entropy;
}

cv::Mat1f flowOrder(const PointTracks& tracks, int sample_grid_px, const Eigen::Matrix3d& ground,
                    cv::Size image, const RefinementParameters& parameters) {
  const int side = sample_grid_px * parameters.entropy_cell_points;
  const int columns = (image.width + side - 1) / side;
  const int rows = (image.height + side - 1) / side;
  const Cell empty{std::vector<int>(static_cast<size_t>(parameters.entropy_bins), 0), 0};
  std::vector<Cell> cells(static_cast<size_t>(columns * rows), empty);
  for (size_t i = 0; i < tracks.current.size(); ++i) {
    const cv::Point2f& now = tracks.current[i];
    const int column = static_cast<int>(std::floor(now.x / static_cast<float>(side)));
    const int row = static_cast<int>(std::floor(now.y / static_cast<float>(side)));
    if (column < 0 || row < 0 || column >= columns || row >= rows) continue;
    Cell& cell = cells[static_cast<size_t>(row * columns + column)];
    ++cell.tracks;
    const Eigen::Vector2d flow =
        Eigen::Vector2d(now.x, now.y) - transfer(ground, {tracks.previous[i].x, tracks.previous[i].y});
    if (!(flow.norm() > parameters.flow_noise_px)) continue;
    ++cell.histogram[static_cast<size_t>(directionBin(flow, parameters.entropy_bins))];
  }
  cv::Mat1f map(image);
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const cv::Rect area = cv::Rect(column * side, row * side, side, side) & cv::Rect({}, image);
      map(area).setTo(order(cells[static_cast<size_t>(row * columns + column)], parameters));
    }
  }
  return map;
}

}  // namespace redbee
