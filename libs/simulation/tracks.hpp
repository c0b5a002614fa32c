// Simulated correspondences over two planes, with the true plane of each.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace redbee::simulation {

enum class TrackOrigin { kGround, kOther, kOutlier };

struct TrackGrid {
  int width = 640;   ///< px
  int height = 480;  ///< px
  int step = 16;     ///< px between points, both ways; the first lie half a step from the border
};

struct SimulatedTracks {
  std::vector<Eigen::Vector2d> before;  ///< ideal pixels of the previous frame
  std::vector<Eigen::Vector2d> after;   ///< ideal pixels of this frame
  std::vector<TrackOrigin> origin;
};

/// Points on a grid, moved by H_ground, or by H_other in the rightmost columns that make up `other_fraction`
/// of the points. A fraction `outlier_ratio` of all points, drawn at random, is displaced by 5 to 30 px. All
/// points except the outliers have white noise of `noise_px` per axis. The same seed gives the same tracks.
SimulatedTracks simulateTracks(const Eigen::Matrix3d& H_ground, const Eigen::Matrix3d& H_other,
                               double other_fraction, double noise_px, double outlier_ratio,
                               const TrackGrid& grid, unsigned seed);

}  // namespace redbee::simulation
