// What the scenarios have in common; internal to them.
#pragma once

#include <random>

#include "redbee/simulation/flight_simulator.hpp"

namespace redbee::simulation {

/// Random numbers, the same on every machine for the same seed.
class Draw {
 public:
  explicit Draw(unsigned seed) : random_(seed * 2654435761U + 17U) {}
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  Eigen::Vector3d vector(double range) {
    const double x = uniform(-range, range), y = uniform(-range, range), z = uniform(-range, range);
    return {x, y, z};
  }
  unsigned seed() { return static_cast<unsigned>(random_()); }
  /// From `low` to `high`.
  int integer(int low, int high) { return low + static_cast<int>(uniform(0, high - low + 1 - 1e-9)); }
  bool chance(double probability) { return uniform(0, 1) < probability; }

 private:
  std::mt19937 random_;
};

/// A flight with the sensors of all scenarios, over a scene that is still empty.
Scenario baseScenario(unsigned seed, Draw& draw, Trajectory trajectory, double pitch_down_deg);

}  // namespace redbee::simulation
