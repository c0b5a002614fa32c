// A vehicle whose camera is small enough for a fuzzer's inputs.
#pragma once

#include "redbee/configuration/configuration.hpp"
#include "redbee/simulation/scenarios.hpp"

namespace redbee::fuzz {

constexpr int kWidth = 32;
constexpr int kHeight = 24;

/// Ground and nothing else.
inline simulation::Scenario smallScenario() {
  simulation::Scenario scenario = simulation::groundOnly(1);
  scenario.intrinsics = {kWidth, kHeight, 25, 25, 15.5, 11.5, {}};
  scenario.imu.rate_hz = 100;
  scenario.altimeter.rate_hz = 20;
  scenario.frames = 4;
  return scenario;
}

inline Configuration smallVehicle() {
  const simulation::Scenario scenario = smallScenario();
  Configuration configuration;
  configuration.camera = scenario.intrinsics;
  configuration.inertial.extrinsics = scenario.extrinsics;
  configuration.inertial.noise = scenario.imu.noise;
  // Few points and RANSAC iterations, as every input runs the whole stack.
  configuration.visual.tracker.grid_px = 8;
  configuration.visual.tracker.window_px = 5;
  configuration.visual.tracker.levels = 1;
  configuration.visual.ransac.min_inliers = 8;
  configuration.visual.ransac.max_iterations = 20;
  configuration.front.ransac.min_inliers = 8;
  configuration.front.ransac.max_iterations = 20;
  configuration.detection.learning_frames = 1;
  configuration.overlay_period_frames = 2;
  return configuration;
}

}  // namespace redbee::fuzz
