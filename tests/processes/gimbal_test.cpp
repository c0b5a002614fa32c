// A simulated flight whose gimbal turns the camera against the IMU, with exact truth: what the stack makes of
// it with GIMBAL, as if the camera were fixed, and by vision alone.
#include <gtest/gtest.h>

#include <algorithm>

#include "redbee/geometry/angle.hpp"
#include "tests/support/flight_measures.hpp"

namespace redbee::test {
namespace {

constexpr int kFrames = 96;
constexpr int kSettled = 24;

const simulation::Scenario& scenario() {
  static const simulation::Scenario gimbal = simulation::gimbalWalkers(2);
  return gimbal;
}

simulation::Scenario withErrors(const simulation::GimbalErrors& errors, double rate_hz = 50) {
  simulation::Scenario changed = scenario();
  changed.gimbal->errors = errors;
  changed.gimbal->rate_hz = rate_hz;
  return changed;
}

TEST(GimbalFlight, TheInertialHomographyHoldsWhileTheGimbalTurns) {
  StackFlight flight = stackFlight(scenario(), kFrames);
  const FlightMeasures used = measured("GIMBAL used", flight);
  flight.configuration.inertial.gimbal.enabled = false;
  const FlightMeasures ignored = measured("GIMBAL ignored", flight);
  flight.configuration.has_imu = false;
  measured("vision alone", flight);
  simulation::Scenario fixed = simulation::briskWalkers(2);
  const FlightMeasures fixed_mount = measured("fixed mount, the same body", stackFlight(fixed, kFrames));
  EXPECT_EQ(used.inertial_part, 1);
  EXPECT_LT(used.inertial_px, 1.5);
  EXPECT_EQ(ignored.inertial_part, 0) << "vision contradicts it: there was something to heed";
  EXPECT_LT(used.error_at_half_recall, fixed_mount.error_at_half_recall + 0.05);
}

/// The frames that no GIMBAL surrounds are vision's alone, and said; no frame is lost.
TEST(GimbalFlight, WithoutGimbalTheFrameGoesOnWithVision) {
  constexpr int kSilent = 60;
  StackFlight flight = stackFlight(scenario(), kFrames);
  const int64_t from = flight.frame_utimes[kSilent];
  auto& messages = flight.messages;
  messages.erase(
      std::remove_if(messages.begin(), messages.end(),
                     [&](const SensorMessage& m) { return m.channel == "GIMBAL" && m.utime >= from; }),
      messages.end());
  const StackOutput output = StackRun(flight).run();
  for (int k = kSettled; k < kFrames; ++k) {
    const int64_t utime = flight.frame_utimes[static_cast<size_t>(k)];
    ASSERT_EQ(output.fused.count(utime), 1u) << k;
    const bool is_silent = k > kSilent;
    if (k == kSilent) continue;  // the last message may lie on either side of it
    EXPECT_EQ(output.fused.at(utime).source,
              is_silent ? fused_homography_t::VISUAL : fused_homography_t::FUSED)
        << k;
    EXPECT_EQ(output.inertial.at(utime).status == inertial_homography_t::NO_GIMBAL, is_silent) << k;
    EXPECT_EQ(output.foreground.at(utime).status, foreground_t::GOOD) << k;
  }
  const process_health_t& health = output.health.at("redbee-imu-integration");
  EXPECT_EQ(health.state, process_health_t::DEGRADED);
  EXPECT_NE(health.message.find("no GIMBAL"), std::string::npos) << health.message;
}

struct Inexactness {
  const char* name;
  simulation::GimbalErrors errors;
  double rate_hz;
  double most_px;  ///< of the inertial homography
};

/// What a gimbal's angles are off by costs the inertial homography, in proportion; the masks, which its
/// covariance protects, hardly at all.
TEST(GimbalFlight, ErrorsOfTheAnglesAreWeighedAsTheyDeserve) {
  const Eigen::Vector3d bias = 3 * kDegree * Eigen::Vector3d(0.6, -0.6, 0.5).normalized();
  const Inexactness cases[] = {{"exact angles", {}, 50, 0.1},
                               {"3 deg of bias", {bias, 0, 0, 1}, 50, 0.3},
                               {"0.3 deg of noise", {Eigen::Vector3d::Zero(), 0.3 * kDegree, 0, 1}, 50, 7},
                               {"30 ms late", {Eigen::Vector3d::Zero(), 0, 0.03, 1}, 50, 4},
                               {"10 Hz", {}, 10, 4}};
  double exact = 0;
  for (const Inexactness& each : cases) {
    StackFlight flight = stackFlight(withErrors(each.errors, each.rate_hz), kFrames);
    if (each.errors.noise_sigma > 0)
      flight.configuration.inertial.gimbal.angle_sigma_deg = each.errors.noise_sigma / kDegree;
    const FlightMeasures found = measured(each.name, flight);
    if (exact == 0) exact = found.error_at_half_recall;
    EXPECT_LT(found.inertial_px, each.most_px) << each.name;
    EXPECT_LT(found.error_at_half_recall, exact + 0.03) << each.name;
    EXPECT_LT(found.fused_px, 0.05) << each.name;
  }
}

}  // namespace
}  // namespace redbee::test
