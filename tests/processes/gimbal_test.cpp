// A simulated flight whose gimbal turns the camera against the IMU, with exact truth: what the stack makes of
// it with GIMBAL, as if the camera were fixed, and by vision alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <opencv2/imgcodecs.hpp>

#include "processes/conversions.hpp"
#include "redbee/evaluation/pixel_measures.hpp"
#include "redbee/geometry/angle.hpp"
#include "tests/support/stack_run.hpp"

namespace redbee::test {
namespace {

constexpr int kFrames = 96;
constexpr int kSettled = 24;

struct Result {
  double error_at_half_recall = 0;
  double inertial_px = 0;    ///< mean transfer error of the inertial homographies that were valid
  double inertial_part = 0;  ///< of the frames that had one
  double fused_px = 0;       ///< mean transfer error
  double normalised =
      0;  ///< mean squared error of the inertial homographies by their covariances; 8 expected
};

Result measure(const StackFlight& flight, const StackOutput& output) {
  Result result;
  PixelMeasures measures;
  int valid = 0, frames = 0;
  for (int k = kSettled; k < kFrames; ++k) {
    const auto index = static_cast<size_t>(k);
    const int64_t utime = flight.frame_utimes[index];
    const Eigen::Matrix3d& truth = flight.homographies[index];
    measures.add(cv::imdecode(output.foreground.at(utime).probability, cv::IMREAD_GRAYSCALE),
                 flight.masks[index]);
    result.fused_px += groundError(output.fused.at(utime), truth);
    ++frames;
    const inertial_homography_t& inertial = output.inertial.at(utime);
    if (inertial.valid == 0) continue;
    ++valid;
    result.inertial_px +=
        meanTransferError(matrix3(inertial.ground.H), truth, inertial.width, inertial.height);
  }
  result.error_at_half_recall = measures.errorAtHalfRecall();
  result.fused_px /= frames;
  result.inertial_px /= valid;
  result.inertial_part = static_cast<double>(valid) / frames;
  return result;
}

Result run(const char* name, const StackFlight& flight) {
  const Result result = measure(flight, StackRun(flight).run());
  std::cout << name << ": Error@50% " << result.error_at_half_recall << ", homography " << result.fused_px
            << " px, the inertial one " << result.inertial_px << " px in " << 100 * result.inertial_part
            << " % of the frames\n";
  return result;
}

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
  const Result used = run("GIMBAL used", flight);
  flight.configuration.inertial.gimbal.enabled = false;
  const Result ignored = run("GIMBAL ignored", flight);
  flight.configuration.has_imu = false;
  const Result vision = run("vision alone", flight);
  simulation::Scenario fixed = simulation::briskWalkers(2);
  const Result fixed_mount = run("fixed mount, the same body", stackFlight(fixed, kFrames));
  EXPECT_EQ(used.inertial_part, 1);
  EXPECT_LT(used.inertial_px, 1.5);
  EXPECT_LT(used.inertial_px, ignored.inertial_px / 3) << "there was something to heed";
  EXPECT_LT(used.fused_px, vision.fused_px) << "it is of use";
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

TEST(GimbalFlight, Table) {
  using Errors = simulation::GimbalErrors;
  const Eigen::Vector3d degree = Eigen::Vector3d(0.6, -0.6, 0.5).normalized() * kDegree;
  run("none", stackFlight(withErrors({}), kFrames));
  run("bias 1 deg", stackFlight(withErrors(Errors{degree, 0, 0, 1}), kFrames));
  run("bias 3 deg", stackFlight(withErrors(Errors{3 * degree, 0, 0, 1}), kFrames));
  for (const double sigma : {0.02, 0.1, 0.3}) {
    StackFlight flight = stackFlight(withErrors(Errors{{0, 0, 0}, sigma * kDegree, 0, 1}), kFrames);
    flight.configuration.inertial.gimbal.angle_sigma_deg = sigma;
    run(("noise " + std::to_string(sigma)).c_str(), flight);
  }
  for (const double lag : {0.01, 0.03, 0.1})
    run(("lag " + std::to_string(lag)).c_str(),
        stackFlight(withErrors(Errors{{0, 0, 0}, 0, lag, 1}), kFrames));
  for (const double rate : {10., 20.})
    run(("rate " + std::to_string(rate)).c_str(), stackFlight(withErrors({}, rate), kFrames));
}

}  // namespace
}  // namespace redbee::test
