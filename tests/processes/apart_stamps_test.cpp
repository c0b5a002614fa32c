// Stamps of camera and IMU that are apart by less than what makes the stack leave the IMU out: it flies on
// and says by how much.
#include <gtest/gtest.h>

#include <cstdio>
#include <iostream>

#include "tests/support/fault_trial.hpp"

namespace redbee::test {
namespace {

constexpr int kFrames = 216;  // nine seconds: an estimate needs more than four

process_health_t inertialHealth(double apart_s) {
  StackFlight flight = faultFlight(kFrames);
  flight.configuration.inertial.extrinsics.timeshift_s += apart_s;
  return StackRun(flight).run().health.at("redbee-imu-integration");
}

TEST(ApartStamps, AreReportedInTheHealth) {
  const process_health_t health = inertialHealth(0.03);
  std::cout << health.message << "\n";
  EXPECT_EQ(health.state, process_health_t::DEGRADED);
  double apart_ms = 0;
  EXPECT_EQ(std::sscanf(health.message.c_str(), "the stamps of camera and IMU are %lf ms apart", &apart_ms),
            1)
      << health.message;
  EXPECT_NEAR(apart_ms, 30, 4) << "vision starts at the IMU's prediction, which pulls it";
  EXPECT_NE(health.message.find("camera.timeshift_s: "), std::string::npos) << health.message;
}

TEST(ApartStamps, ThatFitAreNot) {
  const process_health_t health = inertialHealth(0);
  EXPECT_EQ(health.message.find("stamps"), std::string::npos) << health.message;
}

}  // namespace
}  // namespace redbee::test
