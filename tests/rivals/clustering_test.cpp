// The trajectory clusterings of Table I on two rigid motions whose trajectories are exact.
#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <random>

#include "geometry/so3.hpp"
#include "rivals/lrr.hpp"
#include "rivals/randomized_voting.hpp"
#include "rivals/spectral_clustering.hpp"
#include "rivals/ssc.hpp"
#include "rivals/trajectory_rival.hpp"

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

double rightShare(const std::vector<int>& labels) {
  double same = 0;
  for (size_t i = 0; i < labels.size(); ++i) same += labels[i] == (i < kEach ? 0 : 1) ? 1 : 0;
  const double share = same / static_cast<double>(labels.size());
  return std::max(share, 1 - share);
}

TEST(Ssc, SeparatesTwoMotions) { EXPECT_GT(rightShare(sscClusters(unit(twoMotions(false)), 2)), 0.95); }

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

TEST(Ssc, StopsWhereItIsToldTo) {
  const SparseRepresentation answer = sparseRepresentation(unit(twoMotions(false)), 3);
  EXPECT_EQ(answer.iterations, 3);
  EXPECT_FALSE(answer.converged);
}

TEST(Lrr, SeparatesTwoMotions) { EXPECT_GT(rightShare(lrrClusters(unit(twoMotions(false)), 2)), 0.95); }

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
  EXPECT_GT(rightShare(randomizedVotingClusters(twoMotions(true), 2)), 0.95);
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

TEST(Background, IsTheLargestClusterAmongThoseSpreadOut) {
  Eigen::MatrixXd X(4, 12);
  std::vector<int> labels;
  for (Eigen::Index i = 0; i < 12; ++i) {
    const bool crowd = i >= 5;
    X.col(i).tail<2>() =
        crowd ? Eigen::Vector2d(200 + i, 100 + i % 3) : Eigen::Vector2d(150 * (i % 3), 200 * (i % 2));
    labels.push_back(crowd ? 0 : 1);
  }
  EXPECT_EQ(backgroundLabel(X, labels, 2), 1) << "though the crowd in one place is larger";
}

TEST(Background, TakesBackWhatWasSplitOff) {
  const Eigen::MatrixXd X = twoMotions(false);
  std::vector<int> labels(2 * kEach, 0);
  std::fill(labels.begin() + 2 * kEach / 3, labels.begin() + kEach, 1);
  std::fill(labels.begin() + kEach, labels.end(), 2);
  Eigen::MatrixXd wide = X;
  wide.leftCols(kEach) *= 2;  // so that the first motion is the one spread out
  const std::vector<bool> still = backgroundTracks(wide, labels, 3);
  for (size_t i = 0; i < still.size(); ++i) EXPECT_EQ(still[i], i < kEach) << i;
}

TEST(AffineMotion, ExplainsItsOwnTrajectoriesAlone) {
  const Eigen::MatrixXd X = twoMotions(false);
  std::vector<bool> first(2 * kEach, false);
  std::fill_n(first.begin(), kEach, true);
  const Eigen::VectorXd distance = distanceFromAffineMotion(X, first);
  EXPECT_LT(distance.head(kEach).maxCoeff(), 1e-6);
  EXPECT_GT(distance.tail(kEach).minCoeff(), 0.5);
}

}  // namespace
}  // namespace redbee
