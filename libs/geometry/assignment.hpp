// Who belongs to whom at the least total cost.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace redbee {

inline constexpr int kUnassigned = -1;

/// Minimum-cost assignment: the column of each row, such that the sum of costs is least and no column is
/// taken twice. Of a matrix with more rows than columns, the rows that the best assignment leaves out have
/// kUnassigned. Shortest augmenting paths with potentials (Kuhn, Munkres; Jonker and Volgenant 1987),
/// O(min^2 max). Costs must be finite; throws std::invalid_argument where they are not.
std::vector<int> assign(const Eigen::MatrixXd& costs);

}  // namespace redbee
