// Monte Carlo: the errors of simulated flights are as large as the covariance says.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cstdio>

#include "redbee/geolocation/ground_point.hpp"
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

/// The filter believes that errors last for 30 s.
TEST(Consistency, OfAnotherCorrelationThanBelievedThePlaceIsHonestTheVelocityIsNot) {
  Watch watch;
  watch.position_sigma_m = 1;
  watch.attitude_sigma_deg = 2;
  for (const double correlation_s : {3.0, 10.0, 300.0}) {
    watch.error_correlation_s = correlation_s;
    const Consistency result = measured(watch);
    std::printf("errors that last for %3.0f s: NEES %.2f, of the velocity %.2f\n", correlation_s,
                result.nees_position, result.nees_velocity);
    EXPECT_LT(result.nees_position, 2.5);
    if (correlation_s > 30) {
      EXPECT_LT(result.nees_velocity, 2);
    }
  }
}

/// m, root of the trace of what each error alone does to one placed box.
struct Shares {
  double attitude, height, slope, satellites, focal, pixel, foot;
};

Shares sharesOf(double height_m, double depression_deg, double attitude_deg) {
  const GeolocationParameters parameters;
  const auto camera = makeCameraModel(watchingCamera());
  GroundView view;
  view.R_EC = lookingNorth(depression_deg * kDegree, 0);
  view.position.setZero();
  view.position_covariance.setZero();
  view.attitude_covariance.setZero();
  view.height_m = height_m;
  const auto point = groundPointOf(*camera, {639.5, 359.5}, view, 0.01).value();
  const double object_px = 2 * 1000 / point.range_m;  // of two metres
  const double level_m = point.range_m * std::cos(point.depression);
  return {point.J_attitude.norm() * attitude_deg * kDegree,
          point.J_height.norm() * parameters.home_height_sigma_m,
          point.J_height.norm() * level_m * std::tan(parameters.ground_slope_sigma_deg * kDegree),
          std::sqrt(2.0) * 1.5,
          point.J_focal.norm() * parameters.focal_sigma,
          point.J_pixel.norm() * parameters.pixel_sigma_px,
          point.J_pixel.norm() * parameters.foot_sigma * object_px};
}

TEST(Consistency, WhatDominates) {
  std::printf(
      "m, one box at the image's centre: attitude, height 2 m, slope 1 deg, GPS 1.5 m, pixel, foot\n");
  for (const double height : {10.0, 30.0, 100.0}) {
    for (const double depression : {20.0, 45.0, 80.0}) {
      const Shares half = sharesOf(height, depression, 0.5), two = sharesOf(height, depression, 2);
      std::printf("%4.0f m %2.0f deg  %6.2f %6.2f  %6.2f  %6.2f  %5.2f  %5.2f  %5.2f\n", height, depression,
                  half.attitude, two.attitude, half.height, half.slope, half.satellites, half.pixel,
                  half.foot);
      EXPECT_NEAR(two.attitude, 4 * half.attitude, 1e-9);
    }
  }
  // A flat ray multiplies the attitude's error by 1 / sin^2, the height's by 1 / tan of the depression.
  EXPECT_GT(sharesOf(100, 20, 2).attitude, sharesOf(100, 20, 2).height);
  EXPECT_GT(sharesOf(10, 20, 0.5).height, sharesOf(10, 20, 0.5).attitude);
  EXPECT_GT(sharesOf(30, 80, 0.5).satellites, sharesOf(30, 80, 0.5).attitude);
}

}  // namespace
}  // namespace redbee::test
