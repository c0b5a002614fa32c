// Table I of the paper: motion segmentation by clustering point trajectories, made a detector.
//
// Tracks over a sliding window (trajectory_window.hpp) are clustered afresh in every frame by randomised
// voting (randomized_voting.hpp), low-rank representation (lrr.hpp) or sparse subspace clustering (ssc.hpp).
// The background is the largest cluster among those that are spread over the picture; every other track is
// foreground. Each pixel takes the score of the nearest track within twice the tracks' spacing (a Voronoi
// fill). Score: tracks of the background lie below kDecisionScore, all others above; within either side by
// how badly the background's affine motion (a subspace of three dimensions and a mean; Tomasi and Kanade
// 1992) explains the trajectory, half the range at 1 px.
//
// The methods are told the number of motions, which nobody knows here: each gets a few more than one expects,
// and clusters that the background's motion explains as well are joined to it (backgroundTracks()). They are
// batch methods: none says how to run it on a stream, how to tell the background, or how to fill a mask.
#pragma once

#include <functional>

#include "rivals/rival.hpp"
#include "rivals/trajectory_window.hpp"

namespace redbee {

/// Labels 0 .. count - 1 of the columns of 2F x N trajectories.
using TrajectoryClustering = std::function<std::vector<int>(const Eigen::MatrixXd& X, int count)>;

/// Label of the largest cluster whose points spread over the picture like the points as a whole (half their
/// standard deviation both ways); the largest of all where none does. `X`: 2F x N.
int backgroundLabel(const Eigen::MatrixXd& X, const std::vector<int>& labels, int count);

/// Which trajectories are the background's: those with its label, and those of every cluster whose median
/// distance from its affine motion is below 1 px. Told a number of motions, the methods split the background
/// where fewer move.
std::vector<bool> backgroundTracks(const Eigen::MatrixXd& X, const std::vector<int>& labels, int count);

/// Root mean square distance [px] of each trajectory from the affine motion of those with `of[i]` true.
Eigen::VectorXd distanceFromAffineMotion(const Eigen::MatrixXd& X, const std::vector<bool>& of);

class TrajectoryRival : public Rival {
 public:
  /// `motions`: what the clustering is told.
  TrajectoryRival(TrajectoryClustering clustering, int motions, const TrajectoryWindowParameters& parameters);

 private:
  void reset() override { window_.reset(); }
  RivalOutput judge(const RivalInput& input) override;

  TrajectoryClustering clustering_;
  int motions_;
  TrajectoryWindow window_;
};

std::unique_ptr<Rival> makeRandomizedVoting();
std::unique_ptr<Rival> makeLrr();
std::unique_ptr<Rival> makeSsc();

}  // namespace redbee
