#include <Eigen/Geometry>
#include <cmath>

#include "redbee/geometry/angle.hpp"
#include "redbee/simulation/props.hpp"

namespace redbee::simulation {
namespace {

double yawOf(const Motion& motion) {
  return motion.velocity.isZero() ? 0 : std::atan2(motion.velocity.y(), motion.velocity.x());
}

Eigen::Vector2d along(double yaw_rad) { return {std::cos(yaw_rad), std::sin(yaw_rad)}; }

}  // namespace

void Props::setMoving(size_t first, const Motion& motion) {
  if (motion.velocity.isZero()) return;
  ++objects_;
  for (size_t i = first; i < scene_.patches.size(); ++i) {
    Patch& patch = scene_.patches[i];
    patch.kind = PatchKind::kMover;
    patch.motion = motion;
    patch.object = objects_;
  }
}

void Props::addLimb(const Eigen::Vector2d& at, double top_m, double width_m, double length_m,
                    const Material& material, const Motion& motion, double phase_rad, double steps_hz) {
  Patch& limb = addRound(at, top_m - length_m, width_m, length_m, material);
  if (motion.velocity.isZero()) return;
  const double yaw_rad = yawOf(motion), speed = motion.velocity.norm();
  limb.swing = Swing{
      {-std::sin(yaw_rad), std::cos(yaw_rad), 0}, std::min(0.35 + 0.1 * speed, 0.8), steps_hz, phase_rad};
}

void Props::addPerson(const Eigen::Vector2d& at, const Motion& motion) {
  if (!hasRoomFor(6)) return;
  const size_t first = scene_.patches.size();
  const double height_m = draw_.uniform(1.45, 1.95), yaw_rad = yawOf(motion);
  const Material &shirt = oneOf(materials_.clothes), &trousers = oneOf(materials_.clothes);
  const Eigen::Vector2d side(-std::sin(yaw_rad), std::cos(yaw_rad));
  const double steps_hz = 0.5 + 0.35 * motion.velocity.norm(), phase_rad = draw_.uniform(0, kTurn);
  addRound(at, 0.86 * height_m, 0.15, 0.14 * height_m, materials_.skin).shape = PatchShape::kEllipse;
  addRound(at, 0.46 * height_m, draw_.uniform(0.3, 0.46), 0.4 * height_m, shirt);
  for (const double sign : {-1.0, 1.0}) {
    const double phase = phase_rad + (sign > 0 ? kTurn / 2 : 0);
    addLimb(at + sign * 0.09 * side, 0.48 * height_m, 0.15, 0.48 * height_m, trousers, motion, phase,
            steps_hz);
    addLimb(at + sign * 0.24 * side, 0.82 * height_m, 0.1, 0.38 * height_m, shirt, motion, phase + kTurn / 2,
            steps_hz);
  }
  setMoving(first, motion);
}

void Props::addCyclist(const Eigen::Vector2d& at, const Motion& motion) {
  if (!hasRoomFor(7)) return;
  const size_t first = scene_.patches.size();
  const double yaw_rad = yawOf(motion);
  for (const double place_m : {-0.5, 0.5}) {
    const Eigen::Vector2d hub = at + place_m * along(yaw_rad);
    Patch wheel =
        uprightPatch(PatchKind::kFront, hub.x(), hub.y(), yaw_rad + kTurn / 4, 0.65, 0.65, materials_.wheel);
    wheel.shape = PatchShape::kEllipse;
    scene_.patches.push_back(wheel);
  }
  Patch frame = uprightPatch(PatchKind::kFront, at.x(), at.y(), yaw_rad + kTurn / 4, 0.9, 0.12,
                             oneOf(materials_.paints));
  frame.centre.z() = 0.6;
  scene_.patches.push_back(frame);
  addRound(at + 0.1 * along(yaw_rad), 0.85, 0.42, 0.6, oneOf(materials_.clothes));
  addRound(at + 0.25 * along(yaw_rad), 1.42, 0.18, 0.25, materials_.skin).shape = PatchShape::kEllipse;
  const Material& trousers = oneOf(materials_.clothes);
  for (const double phase : {0.0, kTurn / 2}) addLimb(at, 0.95, 0.16, 0.8, trousers, motion, phase, 1.2);
  setMoving(first, motion);
}

void Props::addCar(const Eigen::Vector2d& at, double yaw_rad, const Motion& motion) {
  if (!hasRoomFor(10)) return;
  const size_t first = scene_.patches.size();
  const Material& paint = oneOf(materials_.paints);
  const double length_m = draw_.uniform(3.6, 5.2), breadth_m = draw_.uniform(1.65, 1.95),
               belt_m = draw_.uniform(0.65, 0.85);
  addBox(at, yaw_rad, {length_m, breadth_m, belt_m}, 0.2, paint, paint);
  const Eigen::Vector2d cabin = at - draw_.uniform(-0.1, 0.2) * length_m * along(yaw_rad);
  addBox(cabin, yaw_rad, {length_m * draw_.uniform(0.4, 0.65), breadth_m - 0.2, draw_.uniform(0.45, 0.7)},
         0.2 + belt_m, materials_.glass, paint);
  setMoving(first, motion);
}

void Props::addBoat(const Eigen::Vector2d& at, const Motion& motion) {
  if (!hasRoomFor(6)) return;
  const size_t first = scene_.patches.size();
  const double yaw_rad = yawOf(motion), length_m = draw_.uniform(3, 7);
  addBox(at, yaw_rad, {length_m, 0.3 * length_m, 0.12 * length_m}, 0, oneOf(materials_.paints),
         materials_.wood);
  Material sail = materials_.sand;
  sail.mean = draw_.uniform(170, 225);
  sail.contrast = 5;
  sail.bgr = {1, 1, 1};
  Patch cloth =
      uprightPatch(PatchKind::kFront, at.x(), at.y(), yaw_rad + kTurn / 4 + draw_.uniform(-0.5, 0.5),
                   0.6 * length_m, 1.2 * length_m, sail);
  cloth.centre.z() += 0.2 * length_m;
  cloth.shape = PatchShape::kTriangle;
  scene_.patches.push_back(cloth);
  setMoving(first, motion);
}

}  // namespace redbee::simulation
