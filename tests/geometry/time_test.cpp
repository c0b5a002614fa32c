#include "redbee/geometry/time.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace redbee {
namespace {

TEST(Time, TimeshiftLeadsFromCameraToImuClock) {
  const CameraTime frame(fromUtime(1'000'000));
  EXPECT_EQ(toUtime(toImu(frame, fromSeconds(0.0125))), 1'012'500);
  EXPECT_EQ(toCamera(toImu(frame, fromSeconds(-0.003)), fromSeconds(-0.003)), frame);
}

TEST(Time, NanosecondsAreRoundedToTheNearestMicrosecond) {
  EXPECT_EQ(fromNanoseconds(1499).count(), 1);
  EXPECT_EQ(fromNanoseconds(1500).count(), 2);
  EXPECT_EQ(fromNanoseconds(-1499).count(), -1);
  EXPECT_EQ(fromNanoseconds(-1500).count(), -2);
  EXPECT_EQ(fromNanoseconds(std::numeric_limits<int64_t>::max()).count(), 9223372036854776);
  EXPECT_EQ(fromNanoseconds(std::numeric_limits<int64_t>::min()).count(), -9223372036854776);
}

TEST(Time, SecondsAreRoundedToTheNearestMicrosecond) {
  EXPECT_EQ(fromSeconds(1.001).count(), 1'001'000);  // truncated it would be 1'000'999
  EXPECT_EQ(fromSeconds(-0.0000006).count(), -1);
  EXPECT_EQ(seconds(fromSeconds(0.25)), 0.25);
}

TEST(Time, DifferencesOfPlausibleTimesDoNotOverflow) {
  const ImuTime latest(kMaxTime - Duration(1));
  const ImuTime earliest(-kMaxTime + Duration(1));
  EXPECT_TRUE(isPlausibleTime(latest));
  EXPECT_TRUE(isPlausibleTime(earliest));
  EXPECT_GT(latest - earliest, Duration(0));
  EXPECT_FALSE(isPlausibleTime(ImuTime(kMaxTime)));
  EXPECT_FALSE(isPlausibleTime(CameraTime::min()));
}

}  // namespace
}  // namespace redbee
