#include "redbee/simulation/landscapes.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <optional>

#include "redbee/geometry/angle.hpp"
#include "redbee/simulation/props.hpp"

namespace redbee::simulation {
namespace {

constexpr double kSeconds = 10;  // of flight that the scene is made for
constexpr double kStill = 0.15;  // fraction of the flights in which nothing moves

/// Puts what a scene is made of where the camera will see it.
class Landscape {
 public:
  Landscape(unsigned seed, unsigned kind)
      : draw_(seed * 8U + kind),
        height_m_(4 * std::exp(draw_.uniform(0, std::log(5)))),
        scenario_(baseScenario(seed * 8U + kind, draw_, Trajectory::varied(seed * 8U + kind, height_m_),
                               draw_.uniform(18, 55))),
        materials_(draw_),
        props_(scenario_.scene, materials_, draw_, draw_.chance(0.5) ? draw_.uniform(0.01, 0.06) : 0) {
    scenario_.sensor.colour = true;
    scenario_.sensor.blur_sigma_px = draw_.uniform(0.4, 0.8);
    scenario_.sensor.noise_sigma = draw_.uniform(0.8, 2.5);
    scenario_.sensor.exposure_drift = draw_.chance(0.3) ? draw_.uniform(0.02, 0.1) : 0;
    scenario_.scene.sky_grey = draw_.uniform(170, 225);
    if (draw_.chance(0.7)) {
      const double up = draw_.uniform(35, 70) * kDegree, around = draw_.uniform(0, kTurn);
      scenario_.scene.sun =
          Eigen::Vector3d(std::cos(up) * std::cos(around), std::cos(up) * std::sin(around), std::sin(up));
      scenario_.scene.shadow_gain = draw_.uniform(0.25, 0.55);
    }
    is_still_ = draw_.chance(kStill);
  }

  Draw& draw() { return draw_; }
  Props& props() { return props_; }
  const Materials& materials() const { return materials_; }
  Scene& scene() { return scenario_.scene; }
  bool isStill() const { return is_still_; }
  Scenario take() { return std::move(scenario_); }
  double yaw() { return draw_.uniform(0, kTurn); }

  CameraPose poseAt(double t_s) const {
    return cameraPose(scenario_.trajectory.at(t_s), scenario_.extrinsics);
  }

  /// A place on the ground that is in the image at t_s, if the draw finds one.
  std::optional<Eigen::Vector2d> placeAt(double t_s) {
    constexpr int kAttempts = 20;
    const CameraPose pose = poseAt(t_s);
    const double farthest_m = 7 * height_m_;
    for (int i = 0; i < kAttempts; ++i) {
      const Eigen::Vector3d ray((draw_.uniform(0, 640) - 320) / 500, (draw_.uniform(0, 480) - 240) / 500, 1);
      const Eigen::Vector3d direction = pose.R_CG.transpose() * ray;
      if (direction.z() > -0.05) continue;
      const Eigen::Vector3d at = pose.p_GC - pose.p_GC.z() / direction.z() * direction;
      if ((at - pose.p_GC).norm() < farthest_m) return Eigen::Vector2d(at.head<2>());
    }
    return std::nullopt;
  }

  /// Work(place) for so many places, none within `clear_m` of the camera's path: what is high must not fill
  /// the image.
  template <typename Work>
  void scatter(int count, double clear_m, const Work& work) {
    for (int i = 0; i < count; ++i) {
      const auto place = placeAt(draw_.uniform(0, kSeconds));
      if (place && distanceToPath(*place) >= clear_m) work(*place);
    }
  }

  /// Work(place at t = 0, motion) for so many movers, each in the image at some time.
  template <typename Work>
  void populate(int count, double slowest, double fastest, const Work& work) {
    for (int i = 0; i < count; ++i) {
      const double seen_s = draw_.uniform(0, kSeconds), speed = draw_.uniform(slowest, fastest),
                   yaw_rad = yaw();
      const auto place = placeAt(seen_s);
      if (place) work(*place, motionBy(speed, yaw_rad), seen_s);
    }
  }

  Motion motionBy(double speed, double yaw_rad) {
    Motion motion;
    if (is_still_) return motion;
    motion.velocity = {speed * std::cos(yaw_rad), speed * std::sin(yaw_rad), 0};
    if (draw_.chance(0.15)) {
      const double begin_s = draw_.uniform(1, 7);
      motion.pause = Motion::Pause{begin_s, begin_s + draw_.uniform(1, 3)};
    }
    return motion;
  }

  void addPeople(int count) {
    populate(count, 0.7, 3.2, [&](const Eigen::Vector2d& place, Motion motion, double seen_s) {
      if (draw_.chance(0.2)) motion = {};  // stands
      props_.addPerson(startOf(place, motion, seen_s), motion);
    });
  }
  static Eigen::Vector2d startOf(const Eigen::Vector2d& place, const Motion& motion, double seen_s) {
    return place - motion.displacementAt(seen_s).head<2>();
  }

 private:
  double distanceToPath(const Eigen::Vector2d& place) const {
    double least_m = 1e9;
    for (double t_s = 0; t_s <= kSeconds; t_s += 0.25)
      least_m = std::min(least_m, (poseAt(t_s).p_GC.head<2>() - place).norm());
    return least_m;
  }

  Draw draw_;
  double height_m_;
  Scenario scenario_;
  Materials materials_;
  Props props_;
  bool is_still_ = false;
};

}  // namespace

Scenario park(unsigned seed) {
  Landscape land(seed, 0);
  Draw& draw = land.draw();
  Props& props = land.props();
  land.scene().ground = draw.chance(0.7) ? land.materials().grass : land.materials().sand;
  for (int i = draw.integer(1, 4); i > 0; --i) {
    land.scatter(1, 0, [&](const Eigen::Vector2d& at) {
      props.addStrip(at, land.yaw(), 120, draw.uniform(1.5, 4),
                     draw.chance(0.5) ? land.materials().gravel : land.materials().asphalt);
    });
  }
  land.addPeople(draw.integer(3, 8));
  land.populate(draw.integer(0, 2), 2.5, 5,
                [&](const Eigen::Vector2d& at, const Motion& motion, double seen_s) {
                  props.addCyclist(land.startOf(at, motion, seen_s), motion);
                });
  land.scatter(draw.integer(3, 9), 4, [&](const Eigen::Vector2d& at) { props.addTree(at); });
  land.scatter(draw.integer(0, 4), 4, [&](const Eigen::Vector2d& at) { props.addConifer(at); });
  land.scatter(draw.integer(0, 9), 1, [&](const Eigen::Vector2d& at) { props.addBush(at); });
  land.scatter(draw.integer(0, 6), 1.5, [&](const Eigen::Vector2d& at) { props.addLampPost(at); });
  land.scatter(draw.integer(0, 3), 1, [&](const Eigen::Vector2d& at) { props.addBench(at, land.yaw()); });
  land.scatter(draw.integer(0, 6), 0, [&](const Eigen::Vector2d& at) { props.addRock(at); });
  land.scatter(draw.integer(0, 2), 2,
               [&](const Eigen::Vector2d& at) { props.addFence(at, land.yaw(), draw.uniform(4, 15)); });
  return land.take();
}

Scenario street(unsigned seed) {
  Landscape land(seed, 1);
  Draw& draw = land.draw();
  Props& props = land.props();
  land.scene().ground = land.materials().grass;
  const Eigen::Vector2d middle = land.placeAt(kSeconds / 2).value_or(Eigen::Vector2d(15, 0));
  const double yaw_rad = land.yaw(), half_m = draw.uniform(3, 5);
  const Eigen::Vector2d along(std::cos(yaw_rad), std::sin(yaw_rad)), across(-along.y(), along.x());
  const auto onRoad = [&](const Eigen::Vector2d& at, double side_m) -> Eigen::Vector2d {
    return middle + (at - middle).dot(along) * along + side_m * across;
  };
  for (const double side : {-1.0, 1.0})
    props.addStrip(middle + side * (half_m + 1.2) * across, yaw_rad, 200, 2.4, land.materials().gravel);
  props.addStrip(middle, yaw_rad, 200, 2 * half_m, land.materials().asphalt);
  for (int i = -4; i <= 4; ++i) {
    Material paint = land.materials().gravel;
    paint.mean = 190;
    props.addStrip(middle + 6 * i * along, yaw_rad, 2.5, 0.15, paint);
  }
  land.populate(draw.integer(1, 4), 2, 9, [&](const Eigen::Vector2d& at, const Motion& drawn, double seen_s) {
    const bool is_back = draw.chance(0.5);
    Motion motion = drawn;
    motion.velocity.head<2>() = (is_back ? -1 : 1) * drawn.velocity.norm() * along;
    props.addCar(land.startOf(onRoad(at, (is_back ? 0.5 : -0.5) * half_m), motion, seen_s),
                 is_back ? yaw_rad + kTurn / 2 : yaw_rad, motion);
  });
  land.addPeople(draw.integer(2, 6));
  land.populate(draw.integer(0, 1), 2.5, 5,
                [&](const Eigen::Vector2d& at, const Motion& motion, double seen_s) {
                  props.addCyclist(land.startOf(at, motion, seen_s), motion);
                });
  land.scatter(draw.integer(0, 4), 1.5, [&](const Eigen::Vector2d& at) {
    props.addCar(onRoad(at, draw.chance(0.5) ? half_m - 0.8 : 0.8 - half_m), yaw_rad, {});
  });
  land.scatter(draw.integer(1, 5), 9, [&](const Eigen::Vector2d& at) {
    const double beside_m = std::abs((at - middle).dot(across));
    if (beside_m > half_m + 8) props.addHouse(at, yaw_rad);
  });
  land.scatter(draw.integer(2, 6), 4, [&](const Eigen::Vector2d& at) { props.addTree(at); });
  land.scatter(draw.integer(1, 5), 1.5, [&](const Eigen::Vector2d& at) {
    props.addLampPost(onRoad(at, draw.chance(0.5) ? half_m + 0.5 : -half_m - 0.5));
  });
  land.scatter(draw.integer(0, 4), 1.5, [&](const Eigen::Vector2d& at) { props.addSign(at, land.yaw()); });
  land.scatter(draw.integer(0, 5), 1, [&](const Eigen::Vector2d& at) { props.addBush(at); });
  land.scatter(draw.integer(0, 2), 2,
               [&](const Eigen::Vector2d& at) { props.addFence(at, yaw_rad, draw.uniform(4, 15)); });
  return land.take();
}

Scenario shore(unsigned seed) {
  Landscape land(seed, 2);
  Draw& draw = land.draw();
  Props& props = land.props();
  land.scene().ground = draw.chance(0.7) ? land.materials().sand : land.materials().grass;
  const Eigen::Vector2d edge = land.placeAt(kSeconds / 2).value_or(Eigen::Vector2d(15, 0));
  const double yaw_rad = land.yaw();
  const Eigen::Vector2d seawards(-std::sin(yaw_rad), std::cos(yaw_rad));
  const auto isSea = [&](const Eigen::Vector2d& at) { return (at - edge).dot(seawards) > 0; };
  Patch sea = lyingPatch(PatchKind::kWaving, edge.x() + 150 * seawards.x(), edge.y() + 150 * seawards.y(),
                         yaw_rad, 500, 300, 0.003, land.materials().water);
  sea.waving = Waving{draw.uniform(0.02, 0.12), draw.uniform(0.5, 2.5), draw.uniform(0.4, 1.2), draw.seed()};
  land.scene().patches.push_back(sea);
  land.populate(draw.integer(1, 4), 0.5, 3,
                [&](const Eigen::Vector2d& at, const Motion& motion, double seen_s) {
                  if (isSea(at)) props.addBoat(land.startOf(at, motion, seen_s), motion);
                });
  land.populate(draw.integer(3, 8), 0.7, 3,
                [&](const Eigen::Vector2d& at, const Motion& motion, double seen_s) {
                  if (!isSea(at)) props.addPerson(land.startOf(at, motion, seen_s), motion);
                });
  const auto onLand = [&](const auto& add) {
    return [&, add](const Eigen::Vector2d& at) {
      if (!isSea(at)) add(at);
    };
  };
  land.scatter(draw.integer(3, 15), 0, [&](const Eigen::Vector2d& at) { props.addRock(at); });
  land.scatter(draw.integer(0, 6), 4, onLand([&](const Eigen::Vector2d& at) { props.addTree(at); }));
  land.scatter(draw.integer(0, 6), 1, onLand([&](const Eigen::Vector2d& at) { props.addBush(at); }));
  land.scatter(draw.integer(0, 3), 1.5, onLand([&](const Eigen::Vector2d& at) { props.addLampPost(at); }));
  land.scatter(draw.integer(0, 2), 1,
               onLand([&](const Eigen::Vector2d& at) { props.addBench(at, land.yaw()); }));
  return land.take();
}

}  // namespace redbee::simulation
