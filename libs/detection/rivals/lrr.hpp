// Low-rank representation: Liu, Lin, Yu, "Robust Subspace Segmentation by Low-Rank Representation", ICML
// 2010. Constants are those of the authors' public code for motion segmentation.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace redbee {

/// X = A Z + E, A = X B, B an orthonormal basis of X's row space: X = X (B Z) + E.
struct LowRankRepresentation {
  Eigen::MatrixXd Z;  ///< N x N, B Z of the reduced problem
  Eigen::MatrixXd E;  ///< of the shape of X: what columns do not share
  int iterations = 0;
  double constraint = 0;  ///< largest |X - X Z - E|
  bool converged = false;
};

/// min |Z|_* + lambda |E|_(2,1) by inexact augmented Lagrange multipliers: mu 1e-6, rho 1.1, at most 1e10,
/// tolerance 1e-8.
LowRankRepresentation lowRankRepresentation(const Eigen::MatrixXd& X, double lambda = 4);

/// Labels of the columns of trajectories: a row of ones appended; Z = U S V', rows of U sqrt(S) to unit
/// length, W = (U U')^4 entry by entry, normalised cut.
std::vector<int> lrrClusters(const Eigen::MatrixXd& X, int count);

}  // namespace redbee
