#include "redbee/detection/rivals/trajectory_window.hpp"

#include <algorithm>
#include <utility>

namespace redbee {
namespace {

GridFlowParameters flowParameters() {
  GridFlowParameters parameters;
  parameters.window_px = 11;
  parameters.min_eigenvalue = 1e-4;
  parameters.max_there_and_back_px = 1;
  return parameters;
}

}  // namespace

TrajectoryWindow::TrajectoryWindow(const TrajectoryWindowParameters& parameters)
    : parameters_(parameters), flow_(flowParameters()) {}

void TrajectoryWindow::reset() {
  flow_.reset();
  tracks_.clear();
  filled_ = 0;
}

bool TrajectoryWindow::advance(const cv::Mat1b& grey) {
  const size_t before = tracks_.size();
  const size_t followed = follow(grey);
  const bool good = before == 0 || 10 * followed >= before;
  if (!good) {
    tracks_.clear();
    filled_ = 0;
  }
  filled_ = std::min(filled_ + 1, static_cast<size_t>(parameters_.frames));
  thinAndSeed(grey.size());
  return good;
}

size_t TrajectoryWindow::follow(const cv::Mat1b& grey) {
  std::vector<cv::Point2f> ends;
  for (const Track& track : tracks_) ends.push_back(track.back());
  std::vector<uint8_t> lost;
  const std::vector<cv::Point2f> moved = flow_.follow(grey, ends, lost);
  std::vector<Track> kept;
  for (size_t i = 0; i < tracks_.size(); ++i) {
    if (lost[i] != 0) continue;
    tracks_[i].push_back(moved[i]);
    if (tracks_[i].size() > static_cast<size_t>(parameters_.frames)) tracks_[i].pop_front();
    kept.push_back(std::move(tracks_[i]));
  }
  tracks_ = std::move(kept);
  return tracks_.size();
}

void TrajectoryWindow::thinAndSeed(const cv::Size& image) {
  const int cell = parameters_.grid_px;
  const cv::Size cells((image.width + cell - 1) / cell, (image.height + cell - 1) / cell);
  std::vector<bool> taken(static_cast<size_t>(cells.area()), false);
  const auto cellOf = [&](const cv::Point2f& p) {
    return static_cast<size_t>(static_cast<int>(p.y) / cell * cells.width + static_cast<int>(p.x) / cell);
  };
  std::stable_sort(tracks_.begin(), tracks_.end(),
                   [](const Track& a, const Track& b) { return a.size() > b.size(); });
  std::vector<Track> kept;
  for (Track& track : tracks_) {
    const size_t at = cellOf(track.back());
    if (taken[at]) continue;
    taken[at] = true;
    kept.push_back(std::move(track));
  }
  for (const cv::Point2f& seed : gridPoints(image, {cell, cell})) {
    if (!taken[cellOf(seed)]) kept.push_back({seed});
  }
  tracks_ = std::move(kept);
}

Eigen::MatrixXd TrajectoryWindow::trajectories() const {
  const auto least = static_cast<size_t>(parameters_.least_frames);
  const size_t frames = filled_;
  const auto whole = [&](const Track& track) { return frames >= least && track.size() == frames; };
  const auto count = std::count_if(tracks_.begin(), tracks_.end(), whole);
  Eigen::MatrixXd X(static_cast<Eigen::Index>(2 * frames), count);
  Eigen::Index column = 0;
  for (const Track& track : tracks_) {
    if (!whole(track)) continue;
    for (size_t f = 0; f < frames; ++f) {
      X(static_cast<Eigen::Index>(2 * f), column) = track[f].x;
      X(static_cast<Eigen::Index>(2 * f + 1), column) = track[f].y;
    }
    ++column;
  }
  return X;
}

}  // namespace redbee
