#include "redbee/detection/rivals/spectral_clustering.hpp"

#include <gtest/gtest.h>

namespace redbee::test {
namespace {

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

}  // namespace
}  // namespace redbee::test
