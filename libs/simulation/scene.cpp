#include "redbee/simulation/scene.hpp"

#include <algorithm>
#include <cmath>

namespace redbee::simulation {

double Motion::movingTime(double t_s) const {
  if (!pause) return t_s;
  return t_s - std::clamp(t_s - pause->begin_s, 0.0, pause->end_s - pause->begin_s);
}

Eigen::Vector3d Motion::displacementAt(double t_s) const { return velocity * movingTime(t_s); }

bool Motion::isMovingAt(double t_s) const {
  const bool paused = pause && t_s >= pause->begin_s && t_s < pause->end_s;
  return !paused && !velocity.isZero();
}

Patch uprightPatch(PatchKind kind, double x_m, double y_m, double yaw_rad, double width_m, double height_m,
                   const Material& material) {
  Patch patch;
  patch.kind = kind;
  patch.material = material;
  patch.centre = {x_m, y_m, height_m / 2};
  patch.axis_u = {std::sin(yaw_rad), -std::cos(yaw_rad), 0};
  patch.axis_v = -Eigen::Vector3d::UnitZ();
  patch.width_m = width_m;
  patch.height_m = height_m;
  return patch;
}

Patch lyingPatch(PatchKind kind, double x_m, double y_m, double yaw_rad, double length_m, double breadth_m,
                 double lift_m, const Material& material) {
  Patch patch;
  patch.kind = kind;
  patch.material = material;
  patch.centre = {x_m, y_m, lift_m};
  patch.axis_u = {std::cos(yaw_rad), std::sin(yaw_rad), 0};
  patch.axis_v = {-std::sin(yaw_rad), std::cos(yaw_rad), 0};
  patch.width_m = length_m;
  patch.height_m = breadth_m;
  return patch;
}

}  // namespace redbee::simulation
