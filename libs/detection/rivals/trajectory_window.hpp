// Point tracks over a sliding window of frames, for trajectory clustering.
#pragma once

#include <Eigen/Core>
#include <deque>
#include <opencv2/core.hpp>
#include <vector>

#include "redbee/detection/rivals/grid_flow.hpp"

namespace redbee {

struct TrajectoryWindowParameters {
  int grid_px = 8;       ///< px: one track per cell of this side; empty cells are seeded again
  int frames = 6;        ///< of the window
  int least_frames = 3;  ///< of the window while it fills
};

class TrajectoryWindow {
 public:
  explicit TrajectoryWindow(const TrajectoryWindowParameters& parameters);

  void reset();
  /// Follows all tracks into the image (of one size between resets) and seeds empty cells. Returns false, and
  /// restarts from this image, if fewer than a tenth of the tracks survive.
  bool advance(const cv::Mat1b& grey);

  /// 2F x N, px: x and y of frame f in rows 2f and 2f + 1, a column for every track that spans the whole
  /// window. While the window fills it is as long as it can be; no columns before it has its least length.
  Eigen::MatrixXd trajectories() const;
  const TrajectoryWindowParameters& parameters() const { return parameters_; }

 private:
  using Track = std::deque<cv::Point2f>;

  size_t follow(const cv::Mat1b& grey);
  void thinAndSeed(const cv::Size& image);

  TrajectoryWindowParameters parameters_;
  GridFlow flow_;
  std::vector<Track> tracks_;
  size_t filled_ = 0;  ///< frames since it began, at most those of the window
};

}  // namespace redbee
