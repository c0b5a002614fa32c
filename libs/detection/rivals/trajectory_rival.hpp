// Motion segmentation by clustering of point trajectories (Table I of the paper) as a detector.
//
// Tracks over a sliding window (trajectory_window.hpp), thinned to a coarse grid, are clustered in every
// frame by randomised voting (randomized_voting.hpp), low-rank representation (lrr.hpp) or sparse subspace
// clustering (ssc.hpp). All clusters with at least a given fraction of the tracks are background, since
// ground at different depths, facades and trees are several clusters. Each has an affine motion (a subspace
// of three dimensions and a mean; Tomasi and Kanade 1992). All tracks, including those of the fine grid, are
// scored by their distance from the closest of these motions: half the range at 1 px, minus the tracking
// error. Each pixel takes the score of the nearest track within kReachPx (Voronoi), then the mean over a box,
// with kDecisionScore where the mean F1 of the development clips is best.
//
// The methods need the number of motions, which is unknown here. They are batch methods and do not specify
// how to process a stream, select the background, or fill a mask; this was tuned (EXPERIMENTS.md).
#pragma once

#include <functional>
#include <vector>

#include "redbee/detection/rivals/rival.hpp"
#include "redbee/detection/rivals/trajectory_window.hpp"

namespace redbee {

/// Labels 0 .. count - 1 of the columns of 2F x N trajectories.
using TrajectoryClustering = std::function<std::vector<int>(const Eigen::MatrixXd& X, int count)>;

/// Labels of the clusters with at least this fraction of all tracks; if there is none, of the largest. Labels
/// range from 0 to `count` - 1.
std::vector<int> backgroundLabels(const std::vector<int>& labels, int count, double least_fraction);

/// Root mean square distance [px] of each of `tracks` from the affine motion of those columns of `X` that
/// have `of[i]` true; infinite where they are too few to have one.
Eigen::VectorXd distanceFromAffineMotion(const Eigen::MatrixXd& tracks, const Eigen::MatrixXd& X,
                                         const std::vector<bool>& of);

/// The least distance [px] of each of `tracks` from the affine motions of the columns of `X` that have one of
/// the labels `background`.
Eigen::VectorXd distanceFromBackground(const Eigen::MatrixXd& tracks, const Eigen::MatrixXd& X,
                                       const std::vector<int>& labels, const std::vector<int>& background);

/// A subset of the columns: at most one that ends in each cell of this side [px].
Eigen::MatrixXd thinned(const Eigen::MatrixXd& X, int cell_px);

struct TrajectoryRivalParameters {
  int clustered_px = 24;              ///< px between the tracks that are clustered
  double background_fraction = 0.15;  ///< of these tracks: minimum of a background cluster
};

class TrajectoryRival : public Rival {
 public:
  TrajectoryRival(const ObjectParameters& objects, TrajectoryClustering clustering,
                  const TrajectoryRivalParameters& parameters);

 private:
  void reset() override { window_.reset(); }
  RivalScore scoreFrame(const FrameInput& input) override;

  TrajectoryClustering clustering_;
  TrajectoryRivalParameters parameters_;
  TrajectoryWindow window_;
};

/// The three methods.
class RandomizedVoting : public TrajectoryRival {
 public:
  explicit RandomizedVoting(const ObjectParameters& objects);
};
class Lrr : public TrajectoryRival {
 public:
  explicit Lrr(const ObjectParameters& objects);
};
class Ssc : public TrajectoryRival {
 public:
  explicit Ssc(const ObjectParameters& objects);
};

}  // namespace redbee
