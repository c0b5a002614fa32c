// Monte Carlo: the errors of simulated flights are as large as the covariance says.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cstdio>

#include "redbee/geometry/chi_square.hpp"
#include "tests/geolocation/simulated_watch.hpp"

namespace redbee::test {
namespace {

constexpr int kFlights = 200;

struct Consistency {
  double nees_position = 0;  ///< mean, of two degrees of freedom
  double nees_velocity = 0;
  double median_error_m = 0;
  double median_sigma_m = 0;
  int gaps = 0;
};

Consistency measured(const Watch& watch) {
  Consistency result;
  std::vector<double> errors, sigmas;
  for (unsigned seed = 0; seed < kFlights; ++seed) {
    const WatchOutcome outcome = fly(watch, watchParameters(), 1000 + seed);
    result.gaps += outcome.gaps;
    if (!outcome.target) continue;
    const Target& target = *outcome.target;
    const Eigen::Vector2d e = outcome.position_error, v = outcome.velocity_error;
    result.nees_position += e.dot(target.position_covariance.inverse() * e) / kFlights;
    result.nees_velocity += v.dot(target.velocity_covariance.inverse() * v) / kFlights;
    errors.push_back(e.norm());
    sigmas.push_back(std::sqrt(target.position_covariance.trace()));
  }
  std::nth_element(errors.begin(), errors.begin() + errors.size() / 2, errors.end());
  std::nth_element(sigmas.begin(), sigmas.begin() + sigmas.size() / 2, sigmas.end());
  result.median_error_m = errors[errors.size() / 2];
  result.median_sigma_m = sigmas[sigmas.size() / 2];
  return result;
}

TEST(Consistency, ErrorsAreAsLargeAsTheCovarianceSays) {
  std::printf("height deg  attitude  median error  sigma   NEES position  velocity\n");
  const double low = chiSquareQuantile(0.0005, 2 * kFlights) / kFlights;
  const double high = chiSquareQuantile(0.9995, 2 * kFlights) / kFlights;
  for (const double height : {10.0, 30.0, 100.0}) {
    for (const double depression : {20.0, 30.0, 45.0, 60.0, 80.0}) {
      for (const double attitude : {0.5, 2.0}) {
        Watch watch;
        watch.height_m = height;
        watch.depression_deg = depression;
        watch.attitude_sigma_deg = attitude;
        watch.height_sigma_m = 0.02 * height;
        watch.position_sigma_m = 1;
        const Consistency result = measured(watch);
        std::printf("%4.0f m %3.0f   %.1f deg  %8.2f m  %8.2f m  %8.2f  %8.2f\n", height, depression,
                    attitude, result.median_error_m, result.median_sigma_m, result.nees_position,
                    result.nees_velocity);
        EXPECT_EQ(result.gaps, 0);
        EXPECT_GT(result.nees_position, low);
        EXPECT_LT(result.nees_position, high);
        EXPECT_GT(result.nees_velocity, low);
        EXPECT_LT(result.nees_velocity, high);
      }
    }
  }
  std::printf("band %.2f to %.2f\n", low, high);
}

}  // namespace
}  // namespace redbee::test
