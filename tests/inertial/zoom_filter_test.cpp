// The filter under a lens that zooms: exact homographies, with pixel noise, are fed back, and the filter's
// are compared with the exact ones.
#include <gtest/gtest.h>

#include <iostream>

#include "redbee/simulation/scenarios.hpp"
#include "tests/support/filter_errors.hpp"

namespace redbee::test {
namespace {

constexpr int kFrames = 120;

simulation::Scenario zoomFlight(double error_sigma) {
  simulation::Scenario scenario = simulation::zoomWalkers(3);
  scenario.lens->error_sigma = error_sigma;
  scenario.frames = kFrames;
  return scenario;
}

InertialParameters parametersOf(const simulation::Scenario& scenario, double error_sigma) {
  InertialParameters parameters = filterParameters(scenario);
  parameters.lens.enabled = true;
  parameters.lens.focal_sigma = error_sigma;
  return parameters;
}

FilterErrors errorsOf(const simulation::FlightSimulator& flight, const InertialParameters& parameters,
                      bool may_contradict = false) {
  InertialFilter filter = filterOf(flight, parameters);
  return test::errorsOf(flight, filter, may_contradict);
}

TEST(ZoomFilter, ExactFocalLengthsGiveTheHomographyOfAFixedLens) {
  const simulation::FlightSimulator flight(zoomFlight(0));
  const InertialParameters parameters = parametersOf(flight.scenario(), 0.0002);
  const double used = errorsOf(flight, parameters).px;
  InertialParameters without = parameters;
  without.lens.enabled = false;
  const double ignored = errorsOf(flight, without, true).px;
  simulation::Scenario fixed = flight.scenario();
  fixed.lens.reset();
  const simulation::FlightSimulator same(fixed);
  const double still = errorsOf(same, without).px;
  std::cout << "zoom used " << used << " px, ignored " << ignored << " px, a fixed lens " << still << " px\n";
  EXPECT_LT(used, 1.5 * still + 0.05);
  EXPECT_GT(ignored, 5 * used);
}

TEST(ZoomFilter, TheErrorOfTheFocalLengthIsPartOfTheCovariance) {
  for (const double sigma : {0.001, 0.005}) {
    const simulation::FlightSimulator flight(zoomFlight(sigma));
    simulation::Scenario each_frame = flight.scenario();
    each_frame.lens->rate_hz = each_frame.fps;  // an error of its own in each frame
    const simulation::FlightSimulator stated(each_frame);
    const FilterErrors errors = expectHonestCovariance(stated, parametersOf(each_frame, sigma), sigma);
    EXPECT_GT(errors.px, 100 * sigma) << "f = 500 px";
  }
}

}  // namespace
}  // namespace redbee::test
