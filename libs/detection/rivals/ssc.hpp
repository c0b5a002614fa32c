// Sparse subspace clustering: Elhamifar, Vidal, "Sparse Subspace Clustering: Algorithm, Theory, and
// Applications", TPAMI 2013. Constants are those of the authors' public code for motion segmentation.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace redbee {

/// Each column of X by few others: X = X C, diag(C) = 0, columns of C sum to 1.
struct SparseRepresentation {
  Eigen::MatrixXd C;  ///< N x N
  int iterations = 0;
  double consensus = 0;     ///< largest |Z - C| of the two copies that ADMM brings together
  double affinity_gap = 0;  ///< largest |column sum - 1|
  bool converged = false;   ///< both below the tolerance
};

/// min |C|_1 + mu1/2 |X - X C|^2 by ADMM, lambda = min_i max_(j!=i) |x_i' x_j|, mu1 = 800 / lambda, mu2 =
/// 800. The authors stop after 200 iterations or at 2e-4. Their N x N inverse is applied by Woodbury's
/// identity, since X has few rows: the same numbers in a fraction of the time.
SparseRepresentation sparseRepresentation(const Eigen::MatrixXd& X, int max_iterations = 200,
                                          double tolerance = 2e-4);

/// Labels of the columns: the largest coefficients that make up 70 % of each column's L1 norm, scaled to a
/// largest of 1, W = |C| + |C|', spectral clustering.
std::vector<int> sscClusters(const Eigen::MatrixXd& X, int count);

}  // namespace redbee
