#include "redbee/detection/rivals/flow_clusters.hpp"

#include <gtest/gtest.h>

#include "redbee/detection/rivals/graded_score.hpp"

namespace redbee::test {
namespace {

std::vector<MovingPoint> twoGroups() {
  std::vector<MovingPoint> points;
  for (int i = 0; i < 5; ++i) {
    const auto x = static_cast<float>(10 * i);
    points.push_back({{100 + x, 100}, {3, 0}, 2});
    points.push_back({{100 + x, 110}, {-3, 0}, 6});
  }
  points.push_back({{300, 200}, {5, 5}, 10});
  return points;
}

TEST(FlowClusters, AreOfOnePlaceAndOneMotion) {
  const std::vector<FlowCluster> clusters = clusterFlow(twoGroups(), {});
  ASSERT_EQ(clusters.size(), 2u) << "neighbours that move apart are two, a lonely point is none";
  for (const FlowCluster& cluster : clusters) {
    EXPECT_EQ(cluster.points.size(), 5u);
    EXPECT_NEAR(std::abs(cluster.motion.x), 3, 1e-5);
    EXPECT_NEAR(cluster.centre.x, 120, 1e-4);
  }
  EXPECT_TRUE(clusterFlow({}, {}).empty());
}

TEST(FlowClusters, ScoresAreThoseOfTheStrictestDecision) {
  const cv::Mat map = paintClusters({400, 300}, twoGroups(), {});
  EXPECT_EQ(map.at<uint8_t>(98, 120), gradedScore(2.0F));
  EXPECT_EQ(map.at<uint8_t>(112, 120), gradedScore(4 * std::sqrt(2.0F))) << "the last level below 6";
  EXPECT_EQ(map.at<uint8_t>(200, 300), 0);
}

}  // namespace
}  // namespace redbee::test
