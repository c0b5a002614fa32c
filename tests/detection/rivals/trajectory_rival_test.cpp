#include "redbee/detection/rivals/trajectory_rival.hpp"

#include <gtest/gtest.h>

#include "tests/support/two_motions.hpp"

namespace redbee::test {
namespace {

TEST(TrajectoryBackground, IsWhatHasItsFractionOfTheTracks) {
  const std::vector<int> labels{0, 0, 0, 0, 0, 0, 1, 1, 1, 3};
  EXPECT_EQ(backgroundLabels(labels, 4, 0.5), std::vector<int>{0});
  EXPECT_EQ(backgroundLabels(labels, 4, 0.3), (std::vector<int>{0, 1}));
  EXPECT_EQ(backgroundLabels(labels, 4, 0.05), (std::vector<int>{0, 1, 3})) << "2 has no tracks";
  EXPECT_EQ(backgroundLabels(labels, 4, 0.9), std::vector<int>{0}) << "the largest at least";
}

/// A ground that comes apart: each half explains its own tracks alone.
TEST(TrajectoryBackground, MayMoveInSeveralWays) {
  const Eigen::MatrixXd X = twoMotions(false);
  std::vector<int> labels(2 * kEach, 0);
  std::fill(labels.begin() + kEach, labels.end(), 1);
  std::vector<bool> first(2 * kEach, false);
  std::fill_n(first.begin(), kEach, true);
  const Eigen::VectorXd by_first = distanceFromAffineMotion(X, X, first);
  const Eigen::VectorXd by_both = distanceFromBackground(X, X, labels, {0, 1});
  EXPECT_GT(by_first.tail(kEach).minCoeff(), 0.5);
  EXPECT_LT(by_both.maxCoeff(), 1e-6);
}

TEST(AffineMotion, ExplainsItsOwnTrajectoriesAlone) {
  const Eigen::MatrixXd X = twoMotions(false);
  std::vector<bool> first(2 * kEach, false);
  std::fill_n(first.begin(), kEach, true);
  const Eigen::VectorXd distance = distanceFromAffineMotion(X, X, first);
  EXPECT_LT(distance.head(kEach).maxCoeff(), 1e-6);
  EXPECT_GT(distance.tail(kEach).minCoeff(), 0.5);
}

TEST(AffineMotion, ScoresTracksThatItWasNotFittedTo) {
  const Eigen::MatrixXd X = twoMotions(false);
  std::vector<bool> first(kEach, true);
  const Eigen::VectorXd distance =
      distanceFromAffineMotion(X.rightCols(kEach + 10), X.leftCols(kEach), first);
  EXPECT_LT(distance.head(10).maxCoeff(), 1e-6);
  EXPECT_GT(distance.tail(kEach).minCoeff(), 0.5);
}

TEST(AffineMotion, OfTooFewIsNone) {
  const Eigen::MatrixXd X = twoMotions(false);
  std::vector<bool> few(2 * kEach, false);
  std::fill_n(few.begin(), 3, true);
  EXPECT_TRUE((distanceFromAffineMotion(X, X, few).array() > 1e9).all());
}

TEST(Thinned, KeepsTheFirstInEachCell) {
  Eigen::MatrixXd X = Eigen::MatrixXd::Zero(4, 5);
  X.bottomRows(2) << 1, 7, 9, 1, 9.5,  //
      1, 7, 1, 8, 1.5;
  const Eigen::MatrixXd thin = thinned(X, 8);
  ASSERT_EQ(thin.cols(), 3);
  EXPECT_EQ(thin.row(2), Eigen::RowVector3d(1, 9, 1));
  EXPECT_EQ(thinned(X, 100).cols(), 1);
}

}  // namespace
}  // namespace redbee::test
