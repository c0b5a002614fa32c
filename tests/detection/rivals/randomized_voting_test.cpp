#include "redbee/detection/rivals/randomized_voting.hpp"

#include <gtest/gtest.h>

#include "tests/support/two_motions.hpp"

namespace redbee::test {
namespace {

TEST(RandomizedVoting, SeparatesTwoMotions) {
  EXPECT_GT(rightFraction(randomizedVotingClusters(twoMotions(true), 2)), 0.95);
}

TEST(RandomizedVoting, TooFewPointsAreOneMotion) {
  const std::vector<int> labels = randomizedVotingClusters(twoMotions(true).leftCols(10), 2);
  EXPECT_EQ(std::count(labels.begin(), labels.end(), 0), 10);
}

}  // namespace
}  // namespace redbee::test
