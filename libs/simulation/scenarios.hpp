// Named flights for tests: 640x480, f = 500 px, 24 frames a second, camera pitched down, 5 to 10 m above the
// ground, consumer-grade IMU at 400 Hz with biases and a time shift of a few milliseconds. The same seed
// gives the same flight.
#pragma once

#include <Eigen/Core>

#include "redbee/simulation/flight_simulator.hpp"

namespace redbee::simulation {

/// R_CI of a camera whose optical axis is the IMU's x axis, pitched down by this angle.
Eigen::Matrix3d pitchedMounting(double pitch_down_rad);

/// Grass and nothing else; camera 30 degrees down.
Scenario groundOnly(unsigned seed);
/// Grass, a facade across the left of the view (patch kFacadePatch), and a car that crosses the ground.
Scenario twoPlanes(unsigned seed);
inline constexpr size_t kFacadePatch = 0;
/// Grass, a pond whose surface waves (patch kPondPatch), and a car.
Scenario wavingWater(unsigned seed);
inline constexpr size_t kPondPatch = 0;
/// Grass under a camera pitched 60 degrees down that turns strongly about all axes.
Scenario calibrationFlight(unsigned seed);
/// Grass and five pedestrians; the first one pauses from 3 s to 5 s.
Scenario walkers(unsigned seed);
/// The same over a drone that turns briskly (Trajectory::brisk).
Scenario briskWalkers(unsigned seed);
/// The same over the brisk drone, whose gimbal holds the camera level and pans it slowly. What it says is off
/// by 0.3 degrees, by 0.05 degrees of noise and by 5 ms.
Scenario gimbalWalkers(unsigned seed);
/// The same over the brisk drone, whose lens zooms in and out, by up to 1.5 and at up to 1.6 % a frame. What
/// it says is off by 0.1 %.
Scenario zoomWalkers(unsigned seed);
/// The same flight with a rolling shutter of this read-out time [s].
Scenario withRollingShutter(Scenario scenario, double readout_s);

}  // namespace redbee::simulation
