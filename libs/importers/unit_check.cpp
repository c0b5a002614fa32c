#include "redbee/importers/unit_check.hpp"

#include <spdlog/fmt/fmt.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "redbee/geometry/median.hpp"
#include "redbee/importers/gravity.hpp"

namespace redbee {
namespace {

// m/s^2
constexpr double kGravity = 9.8;
constexpr double kHardestShaking = 60;  ///< median length; of a hand, of an airframe with a bent propeller

/// Specific force and gyro of a stretch of samples.
struct Stretch {
  size_t middle = 0;
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< sum
};

std::vector<Stretch> stretches(const std::vector<ImuSample>& imu, double period_s) {
  // Long enough to average vibration, short enough for the attitude to stay.
  const auto length = std::max<size_t>(4, static_cast<size_t>(0.1 / period_s));
  std::vector<Stretch> all;
  for (size_t begin = 0; begin + length <= imu.size(); begin += length) {
    Stretch stretch;
    stretch.middle = begin + length / 2;
    for (size_t i = begin; i < begin + length; ++i) stretch.force += imu[i].accel;
    all.push_back(stretch);
  }
  return all;
}

/// How far the specific force turns against what the gyro says, in mean, where the gyro counts `scale` times.
/// rad; std::nullopt for too short a recording.
std::optional<double> turnDisagreement(const std::vector<ImuSample>& imu, double period_s, double scale) {
  const std::vector<Stretch> all = stretches(imu, period_s);
  if (all.size() < 3) return std::nullopt;
  double sum = 0;
  for (size_t k = 2; k < all.size(); ++k) {
    Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
    for (size_t i = all[k - 2].middle; i < all[k].middle; ++i) {
      const Eigen::Vector3d angle = scale * seconds(imu[i + 1].time - imu[i].time) * imu[i].gyro;
      const double length = angle.norm();
      if (length > 0) turn = turn * Eigen::Quaterniond(Eigen::AngleAxisd(length, angle / length));
    }
    const Eigen::Vector3d predicted = turn.conjugate() * all[k - 2].force;
    sum += std::atan2(predicted.cross(all[k].force).norm(), predicted.dot(all[k].force));
  }
  return sum / static_cast<double>(all.size() - 2);
}

}  // namespace

double medianPeriod_s(const std::vector<ImuSample>& imu) {
  std::vector<double> periods;
  for (size_t i = 1; i < imu.size(); ++i) periods.push_back(seconds(imu[i].time - imu[i - 1].time));
  return median(periods);
}

std::string firstUnit(const UnitTable& table, const std::string& read_as, const std::string& option,
                      const std::function<bool(double factor)>& fits) {
  const double read = factorOf(table, read_as, option);
  for (const auto& [name, factor] : table) {
    if (name != read_as && fits(factor / read)) return name;
  }
  return "";
}

void checkGravity(const std::vector<ImuSample>& imu, const ImuUnits& read_as, ImuFindings& findings) {
  const double length = medianForce(imu);
  if (isGravity(length)) return;
  const double mean = meanGravity(imu).value_or(length);
  if (isGravity(mean) && length < kHardestShaking) {
    findings.warnings.push_back(
        fmt::format("the accelerometer's median length is {:.3g} m/s^2, as of a sensor that is shaken hard "
                    "(gravity is in "
                    "its mean, {:.3g}): damp it, and check that its range is not exceeded",
                    length, mean));
    return;
  }
  const std::string what =
      fmt::format("the accelerometer's median length is {:.3g} m/s^2, not gravity's 9.8", length);
  const std::string accel_unit = firstUnit(accelUnits(), read_as.accel, "--accel-unit", [&](double factor) {
    const bool is_shaken = isGravity(factor * mean) && factor * length < kHardestShaking;
    return isGravity(factor * length) || is_shaken;
  });
  if (!accel_unit.empty()) {
    findings.faults.push_back(what + ": it fits " + accel_unit + ", give --accel-unit " + accel_unit);
    return;
  }
  const std::string gyro_unit = firstUnit(gyroUnits(), read_as.gyro, "--gyro-unit", [&](double factor) {
    return length > kGravity && isGravity(meanGravity(imu, factor).value_or(0));
  });
  if (!gyro_unit.empty()) {
    findings.faults.push_back(what + ", nor is its mean as the gyro turns it: the gyro fits " + gyro_unit +
                              ", give --gyro-unit " + gyro_unit);
  } else if (std::min(length, mean) < kGravity) {
    findings.faults.push_back(what +
                              ": a phone's \"linear acceleration\" leaves gravity out; record the raw "
                              "accelerometer, or import without the IMU");
  } else {
    findings.faults.push_back(what + ", in no known unit; import without the IMU");
  }
}

void checkTurns(const std::vector<ImuSample>& imu, const ImuUnits& read_as, ImuFindings& findings) {
  // Measured on fifteen recordings: below 10 degrees in the right unit, 13 to 87 where deg/s are read as
  // rad/s, and then at least 5 times the right unit's.
  constexpr double kDisagreement = 10 * M_PI / 180;
  constexpr double kRatio = 4;
  constexpr double kBetter = 0.95;  // a gyro of nearly nothing contradicts no more than none
  const double period_s = medianPeriod_s(imu);
  const auto now = turnDisagreement(imu, period_s, 1);
  if (!now || *now < kDisagreement) return;
  const std::string unit = firstUnit(gyroUnits(), read_as.gyro, "--gyro-unit", [&](double factor) {
    const double other = *turnDisagreement(imu, period_s, factor);
    if (other < std::min(kDisagreement, *now / kRatio)) return true;
    // Of a sensor that is shaken: far better, also than no gyro at all.
    return other < *now / kRatio && other < kBetter * *turnDisagreement(imu, period_s, 0) &&
           isGravity(meanGravity(imu, factor).value_or(0));
  });
  const std::string what = fmt::format(
      "the gyro turns {:.0f} degrees away from the accelerometer's gravity within 0.2 s", *now * 180 / M_PI);
  if (!unit.empty()) {
    findings.faults.push_back(what + ": it fits " + unit + ", give --gyro-unit " + unit);
    return;
  }
  // What shakes the sensor turns the specific force as well, but has no part in its mean.
  const auto mean = meanGravity(imu);
  if (!mean || isGravity(*mean)) return;
  findings.warnings.push_back(fmt::format(
      "{} in every unit, and its mean as the gyro turns it is {:.3g} m/s^2: signs or axes of one of them are "
      "wrong, or the gyro is broken; import without the IMU",
      what, *mean));
}

}  // namespace redbee
