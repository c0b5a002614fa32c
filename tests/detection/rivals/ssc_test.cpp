#include "redbee/detection/rivals/ssc.hpp"

#include <gtest/gtest.h>

#include "tests/support/two_motions.hpp"

namespace redbee::test {
namespace {

TEST(Ssc, SeparatesTwoMotions) { EXPECT_GT(rightFraction(sscClusters(unit(twoMotions(false)), 2)), 0.95); }

TEST(Ssc, SolutionMeetsItsConstraints) {
  const Eigen::MatrixXd X = unit(twoMotions(false));
  const SparseRepresentation answer = sparseRepresentation(X, 2000);
  EXPECT_TRUE(answer.converged) << answer.iterations << " iterations, consensus " << answer.consensus;
  EXPECT_LT(answer.C.diagonal().cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((answer.C.colwise().sum().array() - 1).abs().maxCoeff(), 0.02);
  EXPECT_LT((X - X * answer.C).norm(), 0.02 * X.norm());
  // Sparse: each column leans on its own motion.
  const Eigen::MatrixXd size = answer.C.cwiseAbs();
  const double across = size.topRightCorner(kEach, kEach).sum() + size.bottomLeftCorner(kEach, kEach).sum();
  EXPECT_LT(across, 0.2 * size.sum());
}

TEST(Ssc, StopsAfterTheGivenNumberOfSteps) {
  const SparseRepresentation answer = sparseRepresentation(unit(twoMotions(false)), 3);
  EXPECT_EQ(answer.iterations, 3);
  EXPECT_FALSE(answer.converged);
}

}  // namespace
}  // namespace redbee::test
