// A world made of textured planar patches in G: the ground z = 0, upright fronts, waving surfaces and movers.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "redbee/simulation/texture.hpp"

namespace redbee::simulation {

/// Linear motion at constant velocity, with an optional pause.
struct Motion {
  struct Pause {
    double begin_s, end_s;
  };
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< m/s in G while it moves
  std::optional<Pause> pause;

  /// Displacement since t = 0 [m].
  Eigen::Vector3d displacementAt(double t_s) const;
  bool isMovingAt(double t_s) const;
};

/// A surface whose texture moves incoherently: travelling waves of many directions shift it by some
/// centimetres.
struct Waving {
  double amplitude_m = 0.06;  ///< of each wave's shift
  double wavelength_m = 0.7;  ///< mean
  double frequency_hz = 0.9;  ///< mean
  unsigned seed = 1;
};

enum class PatchKind { kFront, kWaving, kMover };
enum class PatchShape { kRectangle, kEllipse, kPerson };

/// A planar patch: centre + u * axis_u + v * axis_v with |u| <= width / 2, |v| <= height / 2.
struct Patch {
  PatchKind kind = PatchKind::kFront;
  PatchShape shape = PatchShape::kRectangle;
  Material material;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();   ///< m in G, at t = 0
  Eigen::Vector3d axis_u = Eigen::Vector3d::UnitX();  ///< unit, in G
  Eigen::Vector3d axis_v = Eigen::Vector3d::UnitY();  ///< unit, in G, orthogonal to axis_u
  double width_m = 1;
  double height_m = 1;
  Motion motion;                 ///< movers only
  std::optional<Waving> waving;  ///< waving patches only

  Eigen::Vector3d normal() const { return axis_u.cross(axis_v); }
};

struct Scene {
  Material ground;
  std::vector<Patch> patches;  ///< at most 254
  double sky_grey = 205;
};

/// An upright rectangle that stands on the ground, its middle at (x, y), facing the direction `yaw_rad` (0:
/// towards -x, that is towards a drone which comes along +x).
Patch uprightPatch(PatchKind kind, double x_m, double y_m, double yaw_rad, double width_m, double height_m,
                   const Material& material);
/// A rectangle that lies `lift_m` above the ground, its length along `yaw_rad` from +x.
Patch lyingPatch(PatchKind kind, double x_m, double y_m, double yaw_rad, double length_m, double breadth_m,
                 double lift_m, const Material& material);

}  // namespace redbee::simulation
