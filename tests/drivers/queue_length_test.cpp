// How much of what a vehicle sends waits for a stage.
#include <gtest/gtest.h>

#include "redbee/configuration/configuration.hpp"
#include "redbee/node/stage.hpp"

namespace redbee::test {
namespace {

constexpr double kFastest_hz = 1000;  // that autopilot.imu_rate_hz and attitude_rate_hz may be

TEST(QueueLength, HoldsWhatComesUntilAHangingStageIsStartedAgain) {
  const double most = WatchParameters().hang_timeout_s * kFastest_hz;
  EXPECT_GE(kQueueLength<ins_t>, most);
  EXPECT_GE(kQueueLength<altimeter_t>, most);
  EXPECT_GE(kQueueLength<gimbal_t>, most);
  EXPECT_GE(kQueueLength<lens_t>, most);
  EXPECT_GE(kQueueLength<pose_t>, most);
}

}  // namespace
}  // namespace redbee::test
