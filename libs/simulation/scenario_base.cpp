#include "redbee/simulation/scenario_base.hpp"

#include <cmath>
#include <utility>

#include "redbee/geometry/angle.hpp"
#include "redbee/geometry/so3.hpp"
#include "redbee/simulation/scenarios.hpp"

namespace redbee::simulation {

Eigen::Matrix3d pitchedMounting(double pitch_down_rad) {
  const double c = std::cos(pitch_down_rad), s = std::sin(pitch_down_rad);
  Eigen::Matrix3d R_CI;
  R_CI << 0, -1, 0, -s, 0, -c, c, 0, -s;
  return R_CI;
}

Scenario baseScenario(unsigned seed, Draw& draw, Trajectory trajectory, double pitch_down_deg) {
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
  return s;
}

}  // namespace redbee::simulation
