#include "redbee/detection/rivals/datmo.hpp"

#include <gtest/gtest.h>

namespace redbee::test {
namespace {

TEST(GroupFilter, PersistentGroupsAreConfirmed) {
  GroupFilter filter;
  const auto groupAt = [](float x) {
    FlowCluster cluster;
    cluster.centre = {x, 50};
    return cluster;
  };
  // The view moves by 20 px a frame, further than any gate; the group moves with it and 4 px besides.
  const cv::Matx33d H(1, 0, 20, 0, 1, 0, 0, 0, 1);
  for (int k = 0; k < 6; ++k) {
    const auto lasting = filter.confirmedGroups({groupAt(static_cast<float>(50 + 24 * k))}, H);
    EXPECT_EQ(lasting.size(), k + 1 < GroupFilter::kConfirmFrames ? 0u : 1u) << k;
  }
  EXPECT_TRUE(filter.confirmedGroups({groupAt(400)}, H).empty()) << "elsewhere it is another";
}

}  // namespace
}  // namespace redbee::test
