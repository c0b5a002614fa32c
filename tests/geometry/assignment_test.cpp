#include "redbee/geometry/assignment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>

namespace redbee {
namespace {

double costOf(const Eigen::MatrixXd& costs, const std::vector<int>& columns) {
  double sum = 0;
  for (size_t row = 0; row < columns.size(); ++row) {
    if (columns[row] != kUnassigned) sum += costs(static_cast<Eigen::Index>(row), columns[row]);
  }
  return sum;
}

/// Over all assignments of a matrix with at most as many rows as columns.
double leastCost(const Eigen::MatrixXd& costs) {
  std::vector<int> columns(static_cast<size_t>(costs.cols()));
  std::iota(columns.begin(), columns.end(), 0);
  double least = std::numeric_limits<double>::infinity();
  do {
    double sum = 0;
    for (Eigen::Index row = 0; row < costs.rows(); ++row)
      sum += costs(row, columns[static_cast<size_t>(row)]);
    least = std::min(least, sum);
  } while (std::next_permutation(columns.begin(), columns.end()));
  return least;
}

TEST(Assignment, TheGreedyChoiceIsNotTaken) {
  Eigen::MatrixXd costs(2, 2);
  costs << 1, 2, 1.5, 9;  // the cheapest pair first would cost 1 + 9
  EXPECT_EQ(assign(costs), (std::vector<int>{1, 0}));
}

TEST(Assignment, IsTheCheapestOfAllAndTakesNoColumnTwice) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> cost(-3, 3);
  for (int trial = 0; trial < 200; ++trial) {
    const int rows = 1 + trial % 5, columns = rows + trial % 3;
    const Eigen::MatrixXd costs =
        Eigen::MatrixXd::NullaryExpr(rows, columns, [&](Eigen::Index, Eigen::Index) { return cost(random); });
    std::vector<int> assigned = assign(costs);
    EXPECT_NEAR(costOf(costs, assigned), leastCost(costs), 1e-12);
    std::sort(assigned.begin(), assigned.end());
    EXPECT_EQ(std::unique(assigned.begin(), assigned.end()), assigned.end());
  }
}

TEST(Assignment, MoreRowsThanColumnsLeaveTheDearestRowsOut) {
  Eigen::MatrixXd costs(3, 1);
  costs << 3, 1, 2;
  EXPECT_EQ(assign(costs), (std::vector<int>{kUnassigned, 0, kUnassigned}));
}

TEST(Assignment, EmptyMatricesAreFineAndInfiniteCostsAreRefused) {
  EXPECT_TRUE(assign(Eigen::MatrixXd(0, 3)).empty());
  EXPECT_EQ(assign(Eigen::MatrixXd(2, 0)), (std::vector<int>{kUnassigned, kUnassigned}));
  EXPECT_THROW(assign(Eigen::MatrixXd::Constant(2, 2, std::numeric_limits<double>::infinity())),
               std::invalid_argument);
}

}  // namespace
}  // namespace redbee
