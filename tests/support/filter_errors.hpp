// The inertial filter on a simulated flight, exact homographies with pixel noise fed back, against the truth.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <iostream>
#include <random>

#include "redbee/inertial/inertial_filter.hpp"
#include "redbee/simulation/flight_simulator.hpp"
#include "tests/support/camera.hpp"
#include "tests/support/noisy_homography.hpp"

namespace redbee::test {

inline InertialParameters filterParameters(const simulation::Scenario& scenario) {
  InertialParameters parameters;
  parameters.extrinsics = scenario.extrinsics;
  parameters.noise = scenario.imu.noise;
  parameters.feedback_correlation_frames = 1;  // errors of the simulated corrections are independent
  return parameters;
}

/// With all samples of the flight, those of the gimbal as far as they are `told`.
inline InertialFilter filterOf(
    const simulation::FlightSimulator& flight, const InertialParameters& parameters,
    const std::function<bool(const MountSample&)>& told = [](const MountSample&) { return true; }) {
  InertialFilter filter(flight.camera(), parameters);
  for (const ImuSample& sample : flight.imu()) filter.addImu(sample);
  for (const AltitudeSample& sample : flight.altimeter()) filter.addAltitude(sample);
  for (const MountSample& sample : flight.gimbal()) {
    EXPECT_TRUE(!told(sample) || filter.addMount(sample));
  }
  for (const LensSample& sample : flight.lens()) EXPECT_TRUE(filter.addLens(sample));
  return filter;
}

struct FilterErrors {
  double px = 0;          ///< mean transfer error
  double normalised = 0;  ///< mean squared error by the covariance; 8 expected
};

/// Of the frames from the 48th on; each must have a homography, unless vision may contradict the IMU.
inline FilterErrors errorsOf(const simulation::FlightSimulator& flight, InertialFilter& filter,
                             bool may_contradict = false) {
  constexpr int kSettled = 48;
  std::mt19937 random(5);
  FilterErrors errors;
  const int frames = flight.scenario().frames;
  for (int k = 0; k < frames; ++k) {
    const InertialHomography result = filter.advanceTo(flight.frameTime(k));
    if (k == 0) continue;
    EXPECT_TRUE(result.valid || may_contradict) << k << ' ' << toString(result.status);
    const Eigen::Matrix3d exact = flight.homography(k);
    if (k >= kSettled) {
      errors.px += meanTransferError(result.H, exact, kWidth, kHeight) / (frames - kSettled);
      errors.normalised += normalisedErrorSquared(result.H, result.covariance, exact) / (frames - kSettled);
    }
    HomographyObservation observation = noisyHomography(exact, 0.3, random);
    observation.time_previous = result.time_previous;
    observation.time = result.time;
    filter.correct(observation);
  }
  return errors;
}

/// Of a flight whose mount or lens says itself with noise of `sigma`, which the parameters know.
inline FilterErrors expectHonestCovariance(const simulation::FlightSimulator& flight,
                                           const InertialParameters& parameters, double sigma) {
  InertialFilter filter = filterOf(flight, parameters);
  const FilterErrors errors = errorsOf(flight, filter);
  std::cout << sigma << ": " << errors.px << " px, normalised error squared " << errors.normalised
            << " (8 expected)\n";
  EXPECT_GT(errors.normalised, 3);
  EXPECT_LT(errors.normalised, 12);
  return errors;
}

}  // namespace redbee::test
