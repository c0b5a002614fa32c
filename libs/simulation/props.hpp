// What stands and moves in a landscape, made of patches; internal to the scenarios.
#pragma once

#include <Eigen/Core>

#include "redbee/simulation/scenario_base.hpp"
#include "redbee/simulation/scene.hpp"

namespace redbee::simulation {

/// Materials of one landscape.
struct Materials {
  explicit Materials(Draw& draw);

  Material grass, sand, asphalt, gravel, bark, metal, wood, roof, rock, wheel, glass, skin, water;
  std::vector<Material> leaves, walls, paints, clothes;
};

class Props {
 public:
  /// Keeps references. `wind_m`: by how much leaves sway.
  Props(Scene& scene, const Materials& materials, Draw& draw, double wind_m)
      : scene_(scene), materials_(materials), draw_(draw), wind_m_(wind_m) {}

  /// Each stands at `at` [m] on the ground; nothing is added where the scene has no room for it.
  void addTree(const Eigen::Vector2d& at);
  void addConifer(const Eigen::Vector2d& at);
  void addBush(const Eigen::Vector2d& at);
  void addLampPost(const Eigen::Vector2d& at);
  void addSign(const Eigen::Vector2d& at, double yaw_rad);
  void addBench(const Eigen::Vector2d& at, double yaw_rad);
  void addRock(const Eigen::Vector2d& at);
  void addFence(const Eigen::Vector2d& from, double yaw_rad, double length_m);
  void addHouse(const Eigen::Vector2d& at, double yaw_rad);
  /// A strip of the ground.
  void addStrip(const Eigen::Vector2d& middle, double yaw_rad, double length_m, double breadth_m,
                const Material& material);
  /// `motion`: without velocity they stand, and are background.
  void addPerson(const Eigen::Vector2d& at, const Motion& motion);
  void addCyclist(const Eigen::Vector2d& at, const Motion& motion);
  void addCar(const Eigen::Vector2d& at, double yaw_rad, const Motion& motion);
  void addBoat(const Eigen::Vector2d& at, const Motion& motion);

 private:
  bool hasRoomFor(size_t patches) const { return scene_.patches.size() + patches <= 254; }
  const Material& oneOf(const std::vector<Material>& materials);
  Patch& addRound(const Eigen::Vector2d& at, double bottom_m, double width_m, double height_m,
                  const Material& material);
  void addCrown(const Eigen::Vector3d& centre, double width_m, double height_m, const Material& leaves);
  /// Four sides and the top of a box that stands `bottom_m` above the ground.
  void addBox(const Eigen::Vector2d& at, double yaw_rad, const Eigen::Vector3d& size_m, double bottom_m,
              const Material& sides, const Material& top);
  /// What was added since `first` is one object that moves so.
  void setMoving(size_t first, const Motion& motion);
  void addLimb(const Eigen::Vector2d& at, double top_m, double width_m, double length_m,
               const Material& material, const Motion& motion, double phase_rad, double steps_hz);

  Scene& scene_;
  const Materials& materials_;
  Draw& draw_;
  double wind_m_;
  int objects_ = 0;
};

}  // namespace redbee::simulation
