#include "processes/conversions.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "redbee/tracks_t.hpp"

namespace redbee {
namespace {

TEST(Conversions, DamagedPointsAreLeftOut) {
  tracks_t message{};
  message.x_previous = {1, std::numeric_limits<float>::quiet_NaN(), 3, 4};
  message.y_previous = {1, 2, 3, 4};
  message.x = {1, 2, std::numeric_limits<float>::infinity(), 4};
  message.y = {1, 2, 3, -1e30F};
  message.n = 4;
  const PointTracks tracks = tracksOf(message);
  ASSERT_EQ(tracks.current.size(), 1U);
  ASSERT_EQ(tracks.previous.size(), 1U);
  EXPECT_EQ(tracks.current[0].x, 1);
}

}  // namespace
}  // namespace redbee
