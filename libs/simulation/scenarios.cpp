#include "redbee/simulation/scenarios.hpp"

#include <cmath>

#include "redbee/geometry/angle.hpp"
#include "redbee/simulation/scenario_base.hpp"

namespace redbee::simulation {
namespace {

const Eigen::Vector3d kGreen(0.55, 1.0, 0.75), kBrick(0.65, 0.85, 1.3), kBlue(1.5, 1.05, 0.6),
    kRed(0.75, 0.7, 1.5), kBeige(0.8, 1.0, 1.15);

Material grass(Draw& draw) { return {TextureKind::kGrass, draw.seed(), 0.015, 105, 27, kGreen}; }
Material facade(Draw& draw) { return {TextureKind::kFacade, draw.seed(), 0.02, 125, 38, kBrick}; }
Material water(Draw& draw) { return {TextureKind::kWater, draw.seed(), 0.015, 100, 28, kBlue}; }
Material carPaint(Draw& draw) { return {TextureKind::kBody, draw.seed(), 0.02, 165, 45, kRed}; }
Material clothes(Draw& draw, double mean) {
  return {TextureKind::kBody, draw.seed(), 0.01, mean, 38, kBeige};
}

Patch car(Draw& draw, double x_m, double y_m, double yaw_rad, double speed) {
  Patch patch = lyingPatch(PatchKind::kMover, x_m, y_m, yaw_rad, 2.6, 1.3, 0.02, carPaint(draw));
  patch.motion.velocity = speed * patch.axis_u;
  return patch;
}

Patch person(Draw& draw, double x_m, double y_m, double mean_grey, const Eigen::Vector2d& velocity) {
  Patch patch = uprightPatch(PatchKind::kMover, x_m, y_m, 0, 0.6, 1.75, clothes(draw, mean_grey));
  patch.shape = PatchShape::kPerson;
  patch.motion.velocity << velocity, 0;
  return patch;
}

}  // namespace

Scenario groundOnly(unsigned seed) {
  Draw draw(seed);
  Scenario s = baseScenario(seed, draw, Trajectory::ordinary(seed, 6), 30);
  s.scene.ground = grass(draw);
  return s;
}

Scenario twoPlanes(unsigned seed) {
  Draw draw(seed);
  Scenario s = baseScenario(seed, draw, Trajectory::ordinary(seed, 6), 30);
  s.scene.ground = grass(draw);
  // The wall's right edge stays left of the path, and its far end beyond the flight's.
  s.scene.patches.push_back(uprightPatch(PatchKind::kFront, 30, 16, 8 * kDegree, 28, 14, facade(draw)));
  s.scene.patches.push_back(car(draw, 16, -7, (90 + draw.uniform(-10, 10)) * kDegree, 1.5));
  return s;
}

Scenario wavingWater(unsigned seed) {
  Draw draw(seed);
  Scenario s = baseScenario(seed, draw, Trajectory::ordinary(seed, 6), 30);
  s.scene.ground = grass(draw);
  Patch pond = lyingPatch(PatchKind::kWaving, 20, 16, 0, 60, 28, 0.005, water(draw));
  pond.waving = Waving{0.05, 0.7, 0.9, draw.seed()};
  s.scene.patches.push_back(pond);
  s.scene.patches.push_back(car(draw, 8, -3, draw.uniform(-5, 5) * kDegree, 2.6));
  return s;
}

Scenario calibrationFlight(unsigned seed) {
  Draw draw(seed);
  Scenario s = baseScenario(seed, draw, Trajectory::calibration(seed, 6), 60);
  s.scene.ground = grass(draw);
  s.frames = 480;
  return s;
}

Scenario walkers(unsigned seed) {
  Draw draw(seed);
  Scenario s = baseScenario(seed, draw, Trajectory::ordinary(seed, 6), 30);
  s.scene.ground = grass(draw);
  const double greys[] = {190, 45, 200, 170, 40};
  const Eigen::Vector2d starts[] = {{12, -3}, {14, 3.5}, {18, -1}, {20, 5}, {25, 1}};
  const Eigen::Vector2d velocities[] = {{1.4, 0.5}, {1.3, -0.8}, {0.8, 0.9}, {1.0, -1.1}, {-0.6, -0.9}};
  for (int i = 0; i < 5; ++i)
    s.scene.patches.push_back(person(draw, starts[i].x(), starts[i].y(), greys[i], velocities[i]));
  s.scene.patches.front().motion.pause = Motion::Pause{3, 5};
  return s;
}

Scenario briskWalkers(unsigned seed) {
  Scenario s = walkers(seed);
  s.trajectory = Trajectory::brisk(seed, 6);
  return s;
}

Scenario gimbalWalkers(unsigned seed) {
  Scenario s = briskWalkers(seed);
  Gimbal gimbal;
  gimbal.yaw_pitch_roll[0].sinusoids = {{12 * kDegree, 0.2, 0.3}};
  gimbal.yaw_pitch_roll[1].sinusoids = {{6 * kDegree, 0.3, 1.1}};
  gimbal.errors = {Eigen::Vector3d(0.2, -0.2, 0.1) * kDegree, 0.05 * kDegree, 0.005, seed + 404};
  s.gimbal = gimbal;
  return s;
}

Scenario zoomWalkers(unsigned seed) {
  Scenario s = briskWalkers(seed);
  ZoomLens lens;
  lens.logarithm.sinusoids = {{0.4, 0.15, 0}};
  lens.error_sigma = 0.001;
  lens.seed = seed + 505;
  s.lens = lens;
  return s;
}

Scenario withRollingShutter(Scenario scenario, double readout_s) {
  scenario.intrinsics.line_delay_s = readout_s / scenario.intrinsics.height;
  return scenario;
}

}  // namespace redbee::simulation
