// Clustering of points by an affinity: normalised spectral clustering (Ng, Jordan, Weiss 2002).
#pragma once

#include <Eigen/Core>
#include <vector>

namespace redbee {

/// Labels 0 .. count - 1 of the rows of W, which is symmetric and not negative: k-means on the leading
/// eigenvectors of D^-1/2 W D^-1/2. `rows_to_unit`: rows of the eigenvectors scaled to length 1 first (Ng);
/// without, they are divided by the root of the degree (Shi and Malik's cut). The same input gives the same
/// labels. All 0 where there are fewer than two points a cluster.
std::vector<int> spectralClusters(const Eigen::MatrixXd& W, int count, bool rows_to_unit = true);

}  // namespace redbee
