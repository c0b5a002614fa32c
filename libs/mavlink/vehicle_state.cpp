#include "redbee/mavlink/vehicle_state.hpp"

#include <algorithm>
#include <cmath>

#include "redbee/mavlink/axes.hpp"

namespace redbee::mavlink {
namespace {

constexpr double kGravity = 9.80665;  // m/s^2, of "mG"
constexpr double kDegree = M_PI / 180;
constexpr double kMinUpright = 0.866;    // cos 30 deg: beyond it the beam meets other ground
constexpr double kRangeFraction = 0.02;  // of the distance, one sigma of a sensor that does not say
constexpr double kMinRangeSigma_m = 0.05;
constexpr double kRangeSenseless_cm = 255;
constexpr double kErrorPerDilution_m = 3;  // m, of a GPS without its own estimate, times HDOP or VDOP
constexpr double kUnknownPosition_m = 10;
constexpr double kUnknownVelocity_m_s = 0.5;
constexpr double kEarthRadius_m = 6'371'000;  // mean: the step of a second is off by 1e-2 of itself at most
constexpr uint8_t kFix3d = 3;
constexpr uint16_t kUnknown16 = 65535;

/// milli-g and mrad/s.
template <typename Message>
ImuReading scaledReading(const Message& m, ImuTime time, int64_t device_us) {
  ImuReading reading;
  reading.time = time;
  reading.device_us = device_us;
  reading.accel = fluOf(Eigen::Vector3d(m.xacc, m.yacc, m.zacc) * (1e-3 * kGravity));
  reading.gyro = fluOf(Eigen::Vector3d(m.xgyro, m.ygyro, m.zgyro) * 1e-3);
  reading.mag = fluOf(Eigen::Vector3d(m.xmag, m.ymag, m.zmag) * 1e-3);
  return reading;
}

/// A sensor that is not there is sent as zeros.
bool isMeasured(const Eigen::Vector3d& accel) { return accel.allFinite() && !accel.isZero(); }

double squared(double x) { return x * x; }

}  // namespace

std::optional<ImuReading> readingOf(const HighresImu& m, ImuTime time) {
  if ((m.fields_updated & HighresImu::kAccelAndGyro) != HighresImu::kAccelAndGyro || m.id != 0) {
    return std::nullopt;
  }
  ImuReading reading;
  reading.time = time;
  reading.device_us = static_cast<int64_t>(m.time_usec);
  reading.accel = fluOf(Eigen::Vector3d(m.xacc, m.yacc, m.zacc));
  reading.gyro = fluOf(Eigen::Vector3d(m.xgyro, m.ygyro, m.zgyro));
  reading.mag = fluOf(Eigen::Vector3d(m.xmag, m.ymag, m.zmag));
  reading.pressure_hpa = m.abs_pressure;
  reading.pressure_altitude_m = m.pressure_alt;
  if (!isMeasured(reading.accel) || !reading.gyro.allFinite()) return std::nullopt;
  return reading;
}

std::optional<ImuReading> readingOf(const RawImu& m, ImuTime time) {
  const ImuReading reading = scaledReading(m, time, static_cast<int64_t>(m.time_usec));
  if (m.id != 0 || !isMeasured(reading.accel)) return std::nullopt;
  return reading;
}

std::optional<ImuReading> readingOf(const ScaledImu2& m, ImuTime time) {
  const ImuReading reading = scaledReading(m, time, int64_t{m.time_boot_ms} * 1000);
  if (!isMeasured(reading.accel)) return std::nullopt;
  return reading;
}

void VehicleState::note(const GpsRawInt& message, ImuTime time) { gps_ = {time, message}; }
void VehicleState::note(const GlobalPositionInt& message, ImuTime time) { global_ = {time, message}; }
void VehicleState::note(const LocalPositionNed& message, ImuTime time) { local_ = {time, message}; }
void VehicleState::note(const CameraInformation& message) { camera_ = message; }

Eigen::Matrix3d VehicleState::attitudeCovariance() const {
  double heading_deg = parameters_.heading_sigma_deg;
  if (gps_ && gps_->value.hdg_acc > 0) heading_deg = gps_->value.hdg_acc * 1e-5;
  const double tilt = squared(parameters_.attitude_sigma_deg * kDegree);
  return Eigen::Vector3d(tilt, tilt, squared(heading_deg * kDegree)).asDiagonal();
}

Eigen::Matrix3d VehicleState::positionCovariance() const {
  const auto sigma = [](uint32_t accuracy_mm, uint16_t dilution) {
    if (accuracy_mm > 0) return accuracy_mm * 1e-3;
    return dilution == kUnknown16 || dilution == 0 ? kUnknownPosition_m
                                                   : dilution * 0.01 * kErrorPerDilution_m;
  };
  const GpsRawInt gps = gps_ ? gps_->value : GpsRawInt{};
  const double horizontal = squared(sigma(gps.h_acc, gps.eph));
  return Eigen::Vector3d(horizontal, horizontal, squared(sigma(gps.v_acc, gps.epv))).asDiagonal();
}

double VehicleState::velocitySigma() const {
  return gps_ && gps_->value.vel_acc > 0 ? gps_->value.vel_acc * 1e-3 : kUnknownVelocity_m_s;
}

/// Without a fix GLOBAL_POSITION_INT holds whatever the autopilot was last told.
void VehicleState::addMotion(Pose& pose) const {
  if (isFresh(local_, pose.time)) {
    const LocalPositionNed& m = local_->value;
    const Eigen::Vector3d velocity = enuOf({m.vx, m.vy, m.vz});
    const Eigen::Vector3d position = enuOf({m.x, m.y, m.z}) + velocity * seconds(pose.time - local_->time);
    if (velocity.allFinite()) pose.velocity = velocity;
    if (position.allFinite()) pose.local = position;
  }
  const bool has_fix = gps_ && gps_->value.fix_type >= kFix3d;
  if (has_fix && isFresh(global_, pose.time)) {
    const GlobalPositionInt& m = global_->value;
    if (!pose.velocity) pose.velocity = enuOf(Eigen::Vector3d(m.vx, m.vy, m.vz) * 0.01);
    const double dt = seconds(pose.time - global_->time);
    const Eigen::Vector3d step = *pose.velocity * dt;
    GlobalPosition global;
    const double latitude = m.lat * 1e-7 * kDegree;
    global.latitude_deg = m.lat * 1e-7 + step.y() / kEarthRadius_m / kDegree;
    global.longitude_deg =
        m.lon * 1e-7 + step.x() / (kEarthRadius_m * std::max(std::cos(latitude), 1e-3)) / kDegree;
    global.altitude_m = m.alt * 1e-3 + step.z();
    global.home_altitude_m = m.relative_alt * 1e-3 + step.z();
    if (gps_->value.alt_ellipsoid != 0) {
      global.ellipsoid_altitude_m =
          global.altitude_m + (int64_t{gps_->value.alt_ellipsoid} - gps_->value.alt) * 1e-3;
    }
    global.covariance = positionCovariance() + squared(dt * velocitySigma()) * Eigen::Matrix3d::Identity();
    pose.global = global;
  }
  pose.velocity_covariance = squared(velocitySigma()) * Eigen::Matrix3d::Identity();
}

std::optional<Pose> VehicleState::poseAt(const AttitudeQuaternion& m, ImuTime time) {
  const auto ned_from_frd = rotationOf(m.q1, m.q2, m.q3, m.q4);
  if (!ned_from_frd) return std::nullopt;
  attitude_ = {time, *ned_from_frd};
  const Eigen::Vector3d rate(m.rollspeed, m.pitchspeed, m.yawspeed);
  body_rate_ = rate.allFinite() ? rate : Eigen::Vector3d(Eigen::Vector3d::Zero());
  Pose pose;
  pose.time = time;
  pose.enu_from_flu = enuRotation(*ned_from_frd);
  pose.attitude_covariance = attitudeCovariance();
  addMotion(pose);
  return pose;
}

std::optional<HeightReading> VehicleState::heightOf(const DistanceSensor& m, ImuTime time) const {
  constexpr uint8_t kInvalidSignal = 1;
  const bool is_in_range =
      m.current_distance > 0 && m.current_distance >= m.min_distance && m.current_distance <= m.max_distance;
  if (m.orientation != DistanceSensor::kDownward || !is_in_range || m.signal_quality == kInvalidSignal) {
    return std::nullopt;
  }
  if (!isFresh(attitude_, time)) return std::nullopt;
  // The component of the body's down axis along the vertical.
  const double upright = (attitude_->value * Eigen::Vector3d::UnitZ()).z();
  if (upright < kMinUpright) return std::nullopt;
  const double distance = m.current_distance * 0.01;
  const double stated = m.covariance > 0 && m.covariance < kRangeSenseless_cm ? std::sqrt(m.covariance) * 0.01
                                                                              : kRangeFraction * distance;
  // A tilt that is off by its sigma changes the height by d * sin(tilt) * sigma.
  const double tilting =
      distance * std::sqrt(1 - squared(std::min(upright, 1.0))) * parameters_.attitude_sigma_deg * kDegree;
  HeightReading reading;
  reading.time = time;
  reading.height_m = (distance - parameters_.rangefinder_above_camera_m) * upright;
  reading.sigma_m = std::hypot(std::max(stated, kMinRangeSigma_m), tilting);
  return reading;
}

}  // namespace redbee::mavlink
