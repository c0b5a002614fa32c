#include "calibration/calibration.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <iostream>

#include "tests/calibration/simulated_recording.hpp"

namespace redbee::calibration {
namespace {

using simulation::Trajectory;

double rotationError_deg(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  return logSO3(a * b.transpose()).norm() / kTestDegree;
}

void print(const CalibrationResult& result) {
  for (const ParameterReport& p : result.parameters) {
    std::cout << p.name << " [" << p.unit << "]:";
    for (size_t i = 0; i < p.value.size(); ++i) std::cout << " " << p.value[i] << "+-" << p.sigma[i];
    std::cout << "  " << toString(p.verdict) << ": " << p.words << "\n";
  }
  for (const SplitHalfEntry& entry : result.split_half) {
    std::cout << "  halves: " << entry.name << " " << entry.difference << " +- " << entry.sigma << " " << entry.unit << "\n";
  }
  std::cout << "  vision scale " << result.vision_sigma_scale << " imu scale " << result.imu_sigma_scale << " points rms "
            << result.points_rms_px << "\n";
}

TEST(Calibration, scratch) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    const SimulatedRecording r = simulateRecording(Trajectory::calibration(seed, 6), seed);
    const CalibrationResult result = calibrate(r.input);
    std::cout << "seed " << seed << " truth: dt " << r.truth.timeshift_s << " h " << r.truth.start_height_m << " bg "
              << r.gyro_bias.transpose() / kTestDegree << " ba " << r.accel_bias.transpose() << " p "
              << r.truth.p_IC.transpose() << "\n";
    std::cout << "closed form: rot err " << rotationError_deg(result.diagnostics.alignment.hand_eye.R_CI, r.truth.R_CI)
              << " dt " << result.diagnostics.alignment.timeshift_s << " corr "
              << result.diagnostics.alignment.correlation << " exc " << result.excitation.rotation.transpose() << " sig "
              << result.diagnostics.alignment.hand_eye.sigma.transpose() / kTestDegree << "\n";
    std::cout << "rot err " << rotationError_deg(result.values.estimated.R_CI, r.truth.R_CI) << "\n";
    print(result);
  }
}

}  // namespace
}  // namespace redbee::calibration
