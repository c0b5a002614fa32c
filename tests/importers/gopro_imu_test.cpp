#include "redbee/importers/gopro_imu.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/gpmf_bytes.hpp"
#include "tests/support/log_events.hpp"

namespace redbee::test {
namespace {

TEST(GoproImuTest, SamplesLieOnOneClockInTheImuFrame) {
  const GoproStreams streams = readGoproStreams(packets(5));
  ASSERT_EQ(streams.gyro.size(), 2000u);
  ASSERT_EQ(streams.accel.size(), 1000u);
  for (size_t k = 0; k < streams.gyro.size(); ++k)
    ASSERT_NEAR(streams.gyro[k].t_s, static_cast<double>(k) / 400, 1e-9);
  // Stored (Z, X, Y) = (1, 2, 3): I = (-Y, X, Z).
  EXPECT_LT((streams.gyro[7].value - Eigen::Vector3d(-3, 2, 1)).norm(), 1e-12);
  EXPECT_LT((streams.accel[7].value - Eigen::Vector3d(2, 1, 9.81)).norm(), 1e-12);
  EXPECT_EQ(mergeAtGyroTimes(streams).size(), 2000u);
}

TEST(GoproImuTest, ALostPayloadLeavesAHoleAndNoShift) {
  auto some = packets(5);
  some.erase(some.begin() + 2);
  const GoproStreams streams = readGoproStreams(some);
  ASSERT_EQ(streams.gyro.size(), 1600u);
  EXPECT_NEAR(streams.gyro[800].t_s, 3.0, 1e-9);
}

TEST(GoproImuTest, OnePayloadIsSpreadOverItsDuration) {
  const GoproStreams streams = readGoproStreams(packets(1));
  EXPECT_NEAR(streams.gyro[399].t_s, 399.0 / 400, 1e-9);
}

TEST(GoproImuTest, TheAccelerometerIsInterpolated) {
  GoproStreams streams;
  streams.gyro = {{0.5, {0, 0, 0}}, {1.25, {0, 0, 0}}, {3, {0, 0, 0}}};
  streams.accel = {{1, {0, 0, 4}}, {2, {0, 0, 8}}};
  const auto merged = mergeAtGyroTimes(streams);
  EXPECT_EQ(merged[0].accel.z(), 4);
  EXPECT_NEAR(merged[1].accel.z(), 5, 1e-12);
  EXPECT_EQ(merged[2].accel.z(), 8);
  EXPECT_EQ(toUtime(merged[1].time), 1'250'000);
}

TEST(GoproImuTest, UnitsAreChecked) {
  EXPECT_NEAR(readGoproStreams(packets(2, "deg/s")).gyro[0].value.z(), M_PI / 180, 1e-12);
  EXPECT_THROW(readGoproStreams(packets(2, "furlong")), GpmfError);
}

}  // namespace
}  // namespace redbee::test
