// A simulated flight for the inertial filter: its inputs and the errors of its homographies.
#pragma once

#include <random>
#include <vector>

#include "redbee/inertial/inertial_filter.hpp"
#include "tests/support/consumer_imu.hpp"
#include "tests/support/noisy_homography.hpp"
#include "tests/support/simulated_flight.hpp"

namespace redbee::test {

struct FilteredFlight : SimulatedFlight {
  FilteredFlight(unsigned seed, double height_m, const simulation::ImuSimulatorParameters& imu_parameters)
      : SimulatedFlight(seed, height_m), samples(imu(imu_parameters, 8.0)) {}

  InertialParameters parameters() const {
    InertialParameters p;
    p.extrinsics = extrinsics;
    p.noise = consumerNoise();
    p.start_velocity_sigma = 2;
    p.feedback_correlation_frames = 1;  // errors of the simulated corrections are independent
    return p;
  }
  /// A filter with all samples added.
  InertialFilter filter(const InertialParameters& with) const {
    InertialFilter filter(camera(), with);
    for (const ImuSample& sample : samples) filter.addImu(sample);
    return filter;
  }
  /// Simulated visual measurement of the same step, with 0.3 px of noise.
  HomographyObservation observe(const InertialHomography& result, std::mt19937& random) const {
    HomographyObservation z = noisyHomography(homography(result.time_previous, result.time), 0.3, random);
    z.time_previous = result.time_previous;
    z.time = result.time;
    return z;
  }
  double transferError(const InertialHomography& result) const {
    return meanTransferError(result.H, homography(result.time_previous, result.time), kWidth, kHeight);
  }
  /// Mean transfer error over frames [measure_from, frames), with vision fed back [px].
  double errorFedBack(InertialFilter& filter, int frames, int measure_from) const {
    std::mt19937 random(7);
    double sum = 0;
    for (int k = 0; k < frames; ++k) {
      const InertialHomography result = filter.advanceTo(frameTime(k));
      if (!result.valid) continue;
      if (k >= measure_from) sum += transferError(result);
      filter.correct(observe(result, random));
    }
    return sum / (frames - measure_from);
  }

  std::vector<ImuSample> samples;
};

}  // namespace redbee::test
