// Displacement of a waving surface's texture: a sum of travelling waves of different direction, length and
// speed.
#pragma once

#include <Eigen/Core>
#include <array>

#include "redbee/simulation/scene.hpp"

namespace redbee::simulation {

class WaveField {
 public:
  /// The field of `waving` at time t_s.
  WaveField(const Waving& waving, double t_s);

  /// Shift of the texture at (u, v) [m].
  Eigen::Vector2f shiftAt(float u_m, float v_m) const;

 private:
  struct Wave {
    Eigen::Vector2f turns_per_m;
    float turns_at_origin;
    Eigen::Vector2f shift_m;
  };
  std::array<Wave, 5> waves_;
};

}  // namespace redbee::simulation
