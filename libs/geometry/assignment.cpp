#include "redbee/geometry/assignment.hpp"

#include <limits>
#include <stdexcept>

namespace redbee {
namespace {

/// Of a matrix with at least as many columns as rows: the row of each column.
class AugmentingPaths {
 public:
  explicit AugmentingPaths(const Eigen::MatrixXd& costs)
      : costs_(costs),
        row_potential_(static_cast<size_t>(costs.rows()), 0),
        column_potential_(static_cast<size_t>(costs.cols()), 0),
        row_of_(static_cast<size_t>(costs.cols()), kUnassigned) {
    for (int row = 0; row < costs.rows(); ++row) add(row);
  }

  const std::vector<int>& rowOfColumn() const { return row_of_; }

 private:
  static constexpr double kFar = std::numeric_limits<double>::infinity();

  /// Dijkstra over reduced costs from the new row to the nearest free column; the path's matches are swapped.
  void add(int row) {
    const size_t columns = row_of_.size();
    std::vector<double> distance(columns, kFar);
    std::vector<int> previous(columns, kUnassigned);
    std::vector<bool> done(columns, false);
    int current = kUnassigned;
    double reached = 0;
    do {
      const int from = current == kUnassigned ? row : row_of_[static_cast<size_t>(current)];
      relax(from, current, reached, done, distance, previous);
      current = nearest(done, distance);
      reached = distance[static_cast<size_t>(current)];
      done[static_cast<size_t>(current)] = true;
    } while (row_of_[static_cast<size_t>(current)] != kUnassigned);
    updatePotentials(row, reached, done, distance);
    for (int column = current; column != kUnassigned;) {
      const int before = previous[static_cast<size_t>(column)];
      row_of_[static_cast<size_t>(column)] =
          before == kUnassigned ? row : row_of_[static_cast<size_t>(before)];
      column = before;
    }
  }

  void relax(int from, int via, double reached, const std::vector<bool>& done, std::vector<double>& distance,
             std::vector<int>& previous) const {
    for (size_t column = 0; column < done.size(); ++column) {
      if (done[column]) continue;
      const double reduced = costs_(from, static_cast<Eigen::Index>(column)) -
                             row_potential_[static_cast<size_t>(from)] - column_potential_[column];
      if (reached + reduced >= distance[column]) continue;
      distance[column] = reached + reduced;
      previous[column] = via;
    }
  }

  static int nearest(const std::vector<bool>& done, const std::vector<double>& distance) {
    int best = kUnassigned;
    for (size_t column = 0; column < done.size(); ++column) {
      if (!done[column] && (best == kUnassigned || distance[column] < distance[static_cast<size_t>(best)]))
        best = static_cast<int>(column);
    }
    return best;
  }

  void updatePotentials(int row, double reached, const std::vector<bool>& done,
                        const std::vector<double>& distance) {
    row_potential_[static_cast<size_t>(row)] += reached;
    for (size_t column = 0; column < done.size(); ++column) {
      if (!done[column] || row_of_[column] == kUnassigned) continue;
      const double slack = reached - distance[column];
      row_potential_[static_cast<size_t>(row_of_[column])] += slack;
      column_potential_[column] -= slack;
    }
  }

  const Eigen::MatrixXd& costs_;
  std::vector<double> row_potential_;
  std::vector<double> column_potential_;
  std::vector<int> row_of_;
};

}  // namespace

std::vector<int> assign(const Eigen::MatrixXd& costs) {
  if (!costs.allFinite()) throw std::invalid_argument("assign: costs must be finite");
  if (costs.rows() > costs.cols()) {
    const Eigen::MatrixXd transposed = costs.transpose();
    return AugmentingPaths(transposed).rowOfColumn();
  }
  std::vector<int> column_of_row(static_cast<size_t>(costs.rows()), kUnassigned);
  const AugmentingPaths paths(costs);
  for (size_t column = 0; column < paths.rowOfColumn().size(); ++column) {
    const int row = paths.rowOfColumn()[column];
    if (row != kUnassigned) column_of_row[static_cast<size_t>(row)] = static_cast<int>(column);
  }
  return column_of_row;
}

}  // namespace redbee
