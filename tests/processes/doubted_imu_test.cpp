// An IMU that does not fit the images: its axes turned, its units wrong, or images that were stabilised. The
// stack leaves it out, says so, and goes on with vision.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/trusted_frames.hpp"

namespace redbee::test {
namespace {

constexpr int kFrames = 200;
constexpr int kDecided = 96;  ///< frames; the decision takes some seconds where the drone hardly turns

const StackFlight& flight() {
  static const StackFlight flight = faultFlight(kFrames);
  return flight;
}

StackFlight withImu(const std::function<void(ins_t&)>& change) {
  StackFlight changed = flight();
  for (SensorMessage& sent : changed.messages) {
    if (sent.channel != "IMU") continue;
    ins_t m{};
    if (!decodeMessage(sent.data.data(), static_cast<int>(sent.data.size()), m))
      throw std::logic_error("the simulated flight holds a message that does not decode");
    change(m);
    sent = encoded(m);
  }
  return changed;
}

void expectVisionAlone(const StackFlight& changed, const std::string& reason) {
  const StackOutput output = StackRun(changed).run();
  int visual = 0;
  for (int k = kDecided; k < kFrames; ++k) {
    const auto fused = output.fused.find(flight().frame_utimes[static_cast<size_t>(k)]);
    visual += fused != output.fused.end() && fused->second.source == fused_homography_t::VISUAL ? 1 : 0;
  }
  EXPECT_GE(visual, (kFrames - kDecided) * 95 / 100);
  const TrustedFrames frames = trustedFrames(output, flight(), {}, kDecided);
  EXPECT_GE(frames.trusted, frames.expected * 95 / 100);
  EXPECT_EQ(frames.wild, 0);
  // Until it is decided, too, there are masks.
  const TrustedFrames early = trustedFrames(output, flight());
  std::printf("trusted from the end of learning on: %d of %d, wild %d\n", early.trusted, early.expected,
              early.wild);
  EXPECT_GE(early.trusted, early.expected * 85 / 100);
  const process_health_t& inertial = output.health.at("redbee-imu-integration");
  EXPECT_EQ(inertial.state, process_health_t::DEGRADED);
  EXPECT_NE(inertial.message.find(reason), std::string::npos) << inertial.message;
  std::cout << visual << " of " << kFrames - kDecided << " frames by vision alone; " << inertial.message
            << "\n";
}

/// Mounted a quarter turn about the vertical away from where the vehicle file says.
TEST(DoubtedImu, WithTurnedAxes) {
  expectVisionAlone(withImu([](ins_t& m) {
                      for (double* v : {m.gyro, m.accel}) {
                        const double x = v[0];
                        v[0] = v[1];
                        v[1] = -x;
                      }
                    }),
                    "IMU and camera disagree");
}

TEST(DoubtedImu, WithAMirroredAxis) {
  expectVisionAlone(withImu([](ins_t& m) { m.gyro[2] = -m.gyro[2]; }), "IMU and camera disagree");
}

TEST(DoubtedImu, InDegreesASecond) {
  expectVisionAlone(withImu([](ins_t& m) {
                      for (double& rate : m.gyro) rate *= 180 / M_PI;
                    }),
                    "IMU and camera disagree");
}

TEST(DoubtedImu, WithItsAccelerometerInG) {
  expectVisionAlone(withImu([](ins_t& m) {
                      for (double& force : m.accel) force /= 9.81;
                    }),
                    "IMU and camera disagree");
}

/// Electronic stabilisation takes the drone's shaking out of the images; the gyro feels it.
TEST(DoubtedImu, WithStabilisedImages) {
  constexpr double kRate = 0.5, kTurns_hz = 1.1;  // rad/s
  expectVisionAlone(withImu([](ins_t& m) {
                      const double t_s = static_cast<double>(m.utime % 1'000'000'000) * 1e-6;
                      m.gyro[0] += kRate * std::sin(2 * M_PI * kTurns_hz * t_s);
                      m.gyro[1] += kRate * std::cos(2 * M_PI * kTurns_hz * t_s);
                    }),
                    "IMU and camera disagree");
}

}  // namespace
}  // namespace redbee::test
