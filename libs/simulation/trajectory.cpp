#include "redbee/simulation/trajectory.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <initializer_list>
#include <random>

#include "redbee/geometry/angle.hpp"

namespace redbee::simulation {
namespace {

struct Derivatives {
  double value;
  double first;
  double second;
};

Derivatives evaluate(const Channel& channel, double t_s) {
  Derivatives sum{channel.offset + channel.rate * t_s, channel.rate, 0};
  for (const Sinusoid& s : channel.sinusoids) {
    const double omega = kTurn * s.frequency_hz;
    const double angle = omega * t_s + s.phase;
    sum.value += s.amplitude * std::sin(angle);
    sum.first += s.amplitude * omega * std::cos(angle);
    sum.second -= s.amplitude * omega * omega * std::sin(angle);
  }
  return sum;
}

/// Angular rate in the body frame of R = Rz(yaw) Ry(pitch) Rx(roll).
Eigen::Vector3d bodyRate(const Derivatives& yaw, const Derivatives& pitch, const Derivatives& roll) {
  const double sin_roll = std::sin(roll.value), cos_roll = std::cos(roll.value);
  const double sin_pitch = std::sin(pitch.value), cos_pitch = std::cos(pitch.value);
  return {roll.first - yaw.first * sin_pitch, pitch.first * cos_roll + yaw.first * sin_roll * cos_pitch,
          -pitch.first * sin_roll + yaw.first * cos_roll * cos_pitch};
}

class ChannelMaker {
 public:
  explicit ChannelMaker(unsigned seed) : random_(seed) {}

  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

  /// Each amplitude becomes one sinusoid, its frequency drawn from an equal part of [low_hz, high_hz].
  Channel channel(double offset, double rate, std::initializer_list<double> amplitudes, double low_hz,
                  double high_hz) {
    Channel channel{offset, rate, {}};
    const double fraction = (high_hz - low_hz) / static_cast<double>(amplitudes.size());
    double band = low_hz;
    for (const double amplitude : amplitudes) {
      const double frequency = uniform(band, band + fraction);
      channel.sinusoids.push_back({amplitude, frequency, uniform(0, kTurn)});
      band += fraction;
    }
    return channel;
  }

 private:
  std::mt19937 random_;
};

double radians(double degrees) { return degrees * kPi / 180; }

}  // namespace

double Channel::at(double t_s) const { return evaluate(*this, t_s).value; }

TrajectoryState Trajectory::at(double t_s) const {
  TrajectoryState state;
  for (int axis = 0; axis < 3; ++axis) {
    const Derivatives position = evaluate(parameters_.position[axis], t_s);
    state.p_GI[axis] = position.value;
    state.v_GI[axis] = position.first;
    state.a_GI[axis] = position.second;
  }
  const Derivatives yaw = evaluate(parameters_.yaw_pitch_roll[0], t_s);
  const Derivatives pitch = evaluate(parameters_.yaw_pitch_roll[1], t_s);
  const Derivatives roll = evaluate(parameters_.yaw_pitch_roll[2], t_s);
  state.R_GI = (Eigen::AngleAxisd(yaw.value, Eigen::Vector3d::UnitZ()) *
                Eigen::AngleAxisd(pitch.value, Eigen::Vector3d::UnitY()) *
                Eigen::AngleAxisd(roll.value, Eigen::Vector3d::UnitX()))
                   .toRotationMatrix();
  state.omega_I = bodyRate(yaw, pitch, roll);
  return state;
}

Trajectory Trajectory::ordinary(unsigned seed, double height_m) {
  ChannelMaker make(seed);
  const double forward = make.uniform(1.4, 1.8);
  const double sideways = make.uniform(-0.4, 0.4);
  TrajectoryParameters p;
  p.position[0] = make.channel(0, forward, {0.25, 0.08}, 0.1, 0.7);
  p.position[1] = make.channel(0, sideways, {0.5, 0.1}, 0.1, 0.5);
  p.position[2] = make.channel(height_m, 0, {0.04 * height_m, 0.05}, 0.1, 0.6);
  p.yaw_pitch_roll[0] = make.channel(0, 0, {radians(7), radians(2)}, 0.1, 0.5);
  p.yaw_pitch_roll[1] = make.channel(0, 0, {radians(2.5), radians(1.5)}, 0.1, 0.7);
  p.yaw_pitch_roll[2] = make.channel(0, 0, {radians(3), radians(1.5)}, 0.1, 0.7);
  return Trajectory(p);
}

Trajectory Trajectory::brisk(unsigned seed, double height_m) {
  ChannelMaker make(seed);
  TrajectoryParameters p = ordinary(seed, height_m).parameters_;
  p.yaw_pitch_roll[0] = make.channel(0, 0, {radians(12), radians(6)}, 0.3, 1.0);
  p.yaw_pitch_roll[1] = make.channel(0, 0, {radians(4), radians(2)}, 0.3, 1.0);
  p.yaw_pitch_roll[2] = make.channel(0, 0, {radians(4), radians(2)}, 0.3, 1.0);
  return Trajectory(p);
}

Trajectory Trajectory::varied(unsigned seed, double height_m) {
  ChannelMaker make(seed);
  const double speed = (0.6 + 0.1 * height_m) * make.uniform(0.4, 1.6), course = make.uniform(-1.8, 1.8);
  const double turn = radians(make.uniform(2, 11)), climb = make.uniform(-0.02, 0.03) * height_m;
  TrajectoryParameters p;
  p.position[0] = make.channel(0, speed * std::cos(course), {0.25, 0.08}, 0.1, 0.7);
  p.position[1] = make.channel(0, speed * std::sin(course), {0.5, 0.1}, 0.1, 0.5);
  p.position[2] = make.channel(height_m, climb, {0.04 * height_m, 0.05}, 0.1, 0.6);
  p.yaw_pitch_roll[0] = make.channel(0, radians(make.uniform(-6, 6)), {turn, 0.3 * turn}, 0.1, 0.7);
  p.yaw_pitch_roll[1] = make.channel(0, 0, {0.4 * turn, 0.2 * turn}, 0.1, 0.8);
  p.yaw_pitch_roll[2] = make.channel(0, 0, {0.4 * turn, 0.2 * turn}, 0.1, 0.8);
  return Trajectory(p);
}

Trajectory Trajectory::calibration(unsigned seed, double height_m) {
  ChannelMaker make(seed);
  TrajectoryParameters p;
  p.position[0] = make.channel(0, 0.2, {0.5, 0.25}, 0.15, 0.7);
  p.position[1] = make.channel(0, 0, {0.5, 0.25}, 0.15, 0.7);
  p.position[2] = make.channel(height_m, 0, {0.08 * height_m, 0.1}, 0.15, 0.6);
  p.yaw_pitch_roll[0] = make.channel(0, 0, {radians(17), radians(8)}, 0.3, 1.0);
  p.yaw_pitch_roll[1] = make.channel(0, 0, {radians(15), radians(8)}, 0.3, 1.0);
  p.yaw_pitch_roll[2] = make.channel(0, 0, {radians(17), radians(8)}, 0.3, 1.0);
  return Trajectory(p);
}

}  // namespace redbee::simulation
