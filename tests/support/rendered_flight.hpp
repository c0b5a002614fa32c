// The frames of a simulated flight, rendered once, with their exact motions and homographies.
#pragma once

#include <utility>
#include <vector>

#include "redbee/simulation/flight_simulator.hpp"
#include "redbee/simulation/imu_simulator.hpp"
#include "redbee/simulation/scenarios.hpp"
#include "tests/support/camera.hpp"

namespace redbee::test {

/// The same flight seen by a camera of half the size: for tests that need no detail.
inline simulation::Scenario halfSize(simulation::Scenario scenario) {
  scenario.intrinsics = halved(scenario.intrinsics);
  return scenario;
}

class RenderedFlight {
 public:
  RenderedFlight(simulation::Scenario scenario, int frames)
      : simulator_(withFrames(std::move(scenario), frames)) {
    for (int k = 0; k < frames; ++k) images_.push_back(simulator_.frame(k).image);
  }

  const simulation::FlightSimulator& simulator() const { return simulator_; }
  const simulation::Scenario& scenario() const { return simulator_.scenario(); }
  int frames() const { return static_cast<int>(images_.size()); }
  int64_t utime(int k) const { return toUtime(simulator_.frameTime(k)); }  ///< us, camera's clock
  const simulation::RenderedImage& image(int k) const { return images_[static_cast<size_t>(k)]; }
  /// From frame k-1 to frame k.
  Eigen::Matrix3d homography(int k) const { return simulator_.homography(k); }
  PlaneMotion motion(int k) const { return simulator_.motion(k); }

 private:
  static simulation::Scenario withFrames(simulation::Scenario scenario, int frames) {
    scenario.frames = frames;
    return scenario;
  }

  simulation::FlightSimulator simulator_;
  std::vector<simulation::RenderedImage> images_;
};

}  // namespace redbee::test
