// Stamps of camera and IMU that are apart by less than what makes the stack leave the IMU out: it flies on
// and says by how much.
#include <gtest/gtest.h>

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
  EXPECT_NE(health.message.find("the stamps of camera and IMU are 3"), std::string::npos) << health.message;
  EXPECT_NE(health.message.find("camera.timeshift_s: "), std::string::npos) << health.message;
}

TEST(ApartStamps, ThatFitAreNot) {
  const process_health_t health = inertialHealth(0);
  EXPECT_EQ(health.message.find("stamps"), std::string::npos) << health.message;
}

}  // namespace
}  // namespace redbee::test
