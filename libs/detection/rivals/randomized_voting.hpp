// Randomised voting: Jung, Ju, Kim, "Rigid Motion Segmentation using Randomized Voting", CVPR 2014.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace redbee {

struct RandomizedVotingParameters {
  int rounds = 300;  ///< not published in our sources; chosen, not swept
  double decay_per_px =
      2;              ///< lambda of exp(-lambda d), d the distance to the epipolar line; chosen, not swept
  unsigned seed = 1;  ///< the same input gives the same labels
};

/// Labels 0 .. count - 1 of the columns of 2F x N trajectories [px]. Each round takes two frames of the
/// window; for every motion a fundamental matrix is fitted to 8 of its points drawn at random, and every
/// point votes for the motion by exp(-lambda d); labels follow the sum of votes. All 0 where there are too
/// few points.
std::vector<int> randomizedVotingClusters(const Eigen::MatrixXd& X, int count,
                                          const RandomizedVotingParameters& parameters = {});

}  // namespace redbee
