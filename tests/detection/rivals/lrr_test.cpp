#include "redbee/detection/rivals/lrr.hpp"

#include <gtest/gtest.h>

#include <Eigen/SVD>

#include "tests/support/two_motions.hpp"

namespace redbee::test {
namespace {

TEST(Lrr, SeparatesTwoMotions) { EXPECT_GT(rightFraction(lrrClusters(unit(twoMotions(false)), 2)), 0.95); }

TEST(Lrr, SolutionMeetsItsConstraintAndIsOfLowRank) {
  Eigen::MatrixXd X(2 * kTrajectoryFrames + 1, 2 * kEach);
  X << unit(twoMotions(false)), Eigen::RowVectorXd::Ones(2 * kEach);
  const LowRankRepresentation answer = lowRankRepresentation(X);
  EXPECT_TRUE(answer.converged);
  EXPECT_LT((X - X * answer.Z - answer.E).cwiseAbs().maxCoeff(), 1e-6);
  // Four dimensions a motion at the most; the weakest may go into the errors.
  EXPECT_LE((Eigen::JacobiSVD<Eigen::MatrixXd>(answer.Z).singularValues().array() > 1e-4).count(), 8);
}

TEST(Lrr, AnOutlierColumnGoesIntoTheErrors) {
  Eigen::MatrixXd X = unit(twoMotions(false));
  std::mt19937 random(5);
  std::uniform_real_distribution<double> wild(-1, 1);
  for (Eigen::Index row = 0; row < X.rows(); ++row) X(row, 10) = wild(random);
  const LowRankRepresentation answer = lowRankRepresentation(X, 0.2);
  EXPECT_TRUE(answer.converged);
  Eigen::Index largest = -1;
  answer.E.colwise().norm().maxCoeff(&largest);
  EXPECT_EQ(largest, 10);
}

}  // namespace
}  // namespace redbee::test
