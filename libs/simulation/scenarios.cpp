#include "redbee/simulation/scenarios.hpp"

#include <cmath>
#include <random>

#include "redbee/geometry/angle.hpp"
#include "redbee/geometry/so3.hpp"

namespace redbee::simulation {
namespace {

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

 private:
  std::mt19937 random_;
};

const Eigen::Vector3d kGreen(0.55, 1.0, 0.75), kBrick(0.65, 0.85, 1.3), kBlue(1.5, 1.05, 0.6),
    kRed(0.75, 0.7, 1.5), kBeige(0.8, 1.0, 1.15);

Material grass(Draw& draw) { return {TextureKind::kGrass, draw.seed(), 0.015, 105, 27, kGreen}; }
Material facade(Draw& draw) { return {TextureKind::kFacade, draw.seed(), 0.02, 125, 38, kBrick}; }
Material water(Draw& draw) { return {TextureKind::kWater, draw.seed(), 0.015, 100, 28, kBlue}; }
Material carPaint(Draw& draw) { return {TextureKind::kBody, draw.seed(), 0.02, 165, 45, kRed}; }
Material clothes(Draw& draw, double mean) {
  return {TextureKind::kBody, draw.seed(), 0.01, mean, 38, kBeige};
}

Scenario base(unsigned seed, Draw& draw, Trajectory trajectory, double pitch_down_deg) {
  Scenario s{std::move(trajectory), {}, {}, {}, {}, {}, {}};
  s.intrinsics = {640, 480, 500, 500, 319.5, 239.5, {}};
  s.extrinsics.R_CI = expSO3(draw.vector(0.02)) * pitchedMounting(pitch_down_deg * kDegree);
  s.extrinsics.p_IC = Eigen::Vector3d(0.06, 0, -0.03) + draw.vector(0.02);
  s.extrinsics.timeshift_s = draw.uniform(-0.008, 0.008);
  s.extrinsics.start_height_m = cameraPose(s.trajectory.at(s.extrinsics.timeshift_s), s.extrinsics).p_GC.z();
  s.extrinsics.start_height_sigma_m = 0.3;
  s.imu.gyro_bias = draw.vector(0.005);
  s.imu.accel_bias = draw.vector(0.05);
  s.imu.seed = seed + 101;
  s.altimeter.seed = seed + 202;
  s.sensor.seed = seed + 303;
  s.sensor.blur_sigma_px = 0.5;
  s.scene.ground = grass(draw);
  return s;
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

Eigen::Matrix3d pitchedMounting(double pitch_down_rad) {
  const double c = std::cos(pitch_down_rad), s = std::sin(pitch_down_rad);
  Eigen::Matrix3d R_CI;
  R_CI << 0, -1, 0, -s, 0, -c, c, 0, -s;
  return R_CI;
}

Scenario groundOnly(unsigned seed) {
  Draw draw(seed);
  return base(seed, draw, Trajectory::ordinary(seed, 6), 30);
}

Scenario twoPlanes(unsigned seed) {
  Draw draw(seed);
  Scenario s = base(seed, draw, Trajectory::ordinary(seed, 6), 30);
  // The wall's right edge stays left of the path, and its far end beyond the flight's.
  s.scene.patches.push_back(uprightPatch(PatchKind::kFront, 30, 16, 8 * kDegree, 28, 14, facade(draw)));
  s.scene.patches.push_back(car(draw, 16, -7, (90 + draw.uniform(-10, 10)) * kDegree, 1.5));
  return s;
}

Scenario wavingWater(unsigned seed) {
  Draw draw(seed);
  Scenario s = base(seed, draw, Trajectory::ordinary(seed, 6), 30);
  Patch pond = lyingPatch(PatchKind::kWaving, 20, 16, 0, 60, 28, 0.005, water(draw));
  pond.waving = Waving{0.05, 0.7, 0.9, draw.seed()};
  s.scene.patches.push_back(pond);
  s.scene.patches.push_back(car(draw, 8, -3, draw.uniform(-5, 5) * kDegree, 2.6));
  return s;
}

Scenario calibrationFlight(unsigned seed) {
  Draw draw(seed);
  Scenario s = base(seed, draw, Trajectory::calibration(seed, 6), 60);
  s.frames = 480;
  return s;
}

Scenario walkers(unsigned seed) {
  Draw draw(seed);
  Scenario s = base(seed, draw, Trajectory::ordinary(seed, 6), 30);
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
