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
  /// Time that it has moved for since t = 0 [s].
  double movingTime(double t_s) const;
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

/// To and fro about a place, as leaves in the wind.
struct Sway {
  Eigen::Vector3d amplitude_m = Eigen::Vector3d::Zero();  ///< in G
  double frequency_hz = 0.5;
  double phase_rad = 0;
};

/// Of a limb, while it moves: to and fro about an axis through the middle of its edge at -height / 2.
struct Swing {
  Eigen::Vector3d axis = Eigen::Vector3d::UnitY();  ///< unit, in G
  double amplitude_rad = 0.5;
  double frequency_hz = 1;
  double phase_rad = 0;
};

enum class PatchKind { kFront, kWaving, kMover };
/// kTriangle: its tip at -height / 2. kFoliage: ragged, with gaps.
enum class PatchShape { kRectangle, kEllipse, kPerson, kTriangle, kFoliage };

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
  std::optional<Sway> sway;
  std::optional<Swing> swing;
  /// Of a round body: it turns about axis_v towards who sees it, as the outline of a cylinder does.
  bool is_round = false;
  int object = 0;  ///< movers only: parts of one object share a number; 0: an object of its own

  Eigen::Vector3d normal() const { return axis_u.cross(axis_v); }
};

struct Scene {
  Material ground;
  std::vector<Patch> patches;  ///< at most 254
  double sky_grey = 205;
  /// In G, unit, towards the sun: patches cast shadows on the ground. Absent: no shadows.
  std::optional<Eigen::Vector3d> sun{};
  double shadow_gain = 0.4;  ///< light of the ground in a shadow over that in the sun
};

/// An upright rectangle that stands on the ground, its middle at (x, y), facing the direction `yaw_rad` (0:
/// towards -x, that is towards a drone which comes along +x).
Patch uprightPatch(PatchKind kind, double x_m, double y_m, double yaw_rad, double width_m, double height_m,
                   const Material& material);
/// A rectangle that lies `lift_m` above the ground, its length along `yaw_rad` from +x.
Patch lyingPatch(PatchKind kind, double x_m, double y_m, double yaw_rad, double length_m, double breadth_m,
                 double lift_m, const Material& material);

}  // namespace redbee::simulation
