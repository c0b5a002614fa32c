// The trajectory clusterings of Table I on two rigid motions whose trajectories are exact.
#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <random>

#include "redbee/detection/rivals/lrr.hpp"
#include "redbee/detection/rivals/randomized_voting.hpp"
#include "redbee/detection/rivals/spectral_clustering.hpp"
#include "redbee/detection/rivals/ssc.hpp"
#include "redbee/detection/rivals/trajectory_rival.hpp"
#include "redbee/geometry/so3.hpp"

namespace redbee {
namespace {

constexpr Eigen::Index kFrames = 8;
constexpr Eigen::Index kEach = 40;

struct TwoMotions {
  Eigen::MatrixXd X;  ///< 2F x N, the first kEach columns of the first motion
};

/// Points of a body 1 m across, 5 m away, that turns and travels; seen at f = 500 px, perspective or affine.
Eigen::MatrixXd bodyTrajectories(std::mt19937& random, const Eigen::Vector3d& centre,
                                 const Eigen::Vector3d& turn, const Eigen::Vector3d& travel,
                                 bool perspective) {
  std::uniform_real_distribution<double> within(-0.8, 0.8);
  Eigen::MatrixXd X(2 * kFrames, kEach);
  for (Eigen::Index i = 0; i < kEach; ++i) {
    const Eigen::Vector3d point(within(random), within(random), within(random));
    for (Eigen::Index f = 0; f < kFrames; ++f) {
      const auto t = static_cast<double>(f);
      const Eigen::Vector3d at = expSO3(t * turn) * point + centre + t * travel;
      const double depth = perspective ? at.z() : centre.z();
      X.block<2, 1>(2 * f, i) = 500 * at.head<2>() / depth;
    }
  }
  return X;
}

Eigen::MatrixXd twoMotions(bool perspective) {
  std::mt19937 random(7);
  Eigen::MatrixXd X(2 * kFrames, 2 * kEach);
  X << bodyTrajectories(random, {-1, 0, 5}, {0.03, 0.05, 0.02}, {0.02, 0.01, 0.05}, perspective),
      bodyTrajectories(random, {1, 0.2, 5}, {-0.04, 0.02, -0.05}, {-0.03, 0.04, -0.06}, perspective);
  return X;
}

Eigen::MatrixXd unit(const Eigen::MatrixXd& X) { return X / X.cwiseAbs().maxCoeff(); }

double rightFraction(const std::vector<int>& labels) {
  double same = 0;
  for (size_t i = 0; i < labels.size(); ++i) same += labels[i] == (i < kEach ? 0 : 1) ? 1 : 0;
  const double share = same / static_cast<double>(labels.size());
  return std::max(share, 1 - share);
}

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

TEST(Lrr, SeparatesTwoMotions) { EXPECT_GT(rightFraction(lrrClusters(unit(twoMotions(false)), 2)), 0.95); }

TEST(Lrr, SolutionMeetsItsConstraintAndIsOfLowRank) {
  Eigen::MatrixXd X(2 * kFrames + 1, 2 * kEach);
  X << unit(twoMotions(false)), Eigen::RowVectorXd::Ones(2 * kEach);
  const LowRankRepresentation answer = lowRankRepresentation(X);
  EXPECT_TRUE(answer.converged);
  EXPECT_LT((X - X * answer.Z - answer.E).cwiseAbs().maxCoeff(), 1e-6);
  // Four dimensions a motion at the most; the weakest may go into the errors.
  EXPECT_LE((Eigen::JacobiSVD<Eigen::MatrixXd>(answer.Z).singularValues().array() > 1e-4).count(), 8);
}

TEST(Lrr, AWildColumnGoesIntoTheErrors) {
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

TEST(RandomizedVoting, SeparatesTwoMotions) {
  EXPECT_GT(rightFraction(randomizedVotingClusters(twoMotions(true), 2)), 0.95);
}

TEST(RandomizedVoting, TooFewPointsAreOneMotion) {
  const std::vector<int> labels = randomizedVotingClusters(twoMotions(true).leftCols(10), 2);
  EXPECT_EQ(std::count(labels.begin(), labels.end(), 0), 10);
}

TEST(SpectralClusters, FindTheBlocksOfAnAffinity) {
  Eigen::MatrixXd W = Eigen::MatrixXd::Constant(30, 30, 0.01);
  W.topLeftCorner(12, 12).setConstant(1);
  W.bottomRightCorner(18, 18).setConstant(1);
  for (const bool rows_to_unit : {true, false}) {
    const std::vector<int> labels = spectralClusters(W, 2, rows_to_unit);
    for (size_t i = 0; i < 30; ++i) EXPECT_EQ(labels[i] == labels[0], i < 12) << i;
  }
}

TEST(SpectralClusters, TooFewPointsAreOneCluster) {
  EXPECT_EQ(spectralClusters(Eigen::MatrixXd::Ones(3, 3), 2), std::vector<int>(3, 0));
}

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

TEST(TrajectoryWindow, IsAsLongAsItCanBeWhileItFills) {
  cv::Mat image(120, 160, CV_8U);
  cv::RNG random(1);
  random.fill(image, cv::RNG::UNIFORM, 0, 255);
  cv::GaussianBlur(image, image, {5, 5}, 0);
  TrajectoryWindowParameters parameters;
  parameters.frames = 5;
  parameters.least_frames = 3;
  TrajectoryWindow window(parameters);
  for (int round = 0; round < 2; ++round) {
    for (int k = 1; k <= 7; ++k) {
      EXPECT_TRUE(window.advance(image));
      const Eigen::MatrixXd X = window.trajectories();
      EXPECT_EQ(X.cols() > 0, k >= 3) << k;
      EXPECT_EQ(X.rows(), 2 * std::min(k, 5)) << k;
    }
    window.reset();
  }
}

}  // namespace
}  // namespace redbee
