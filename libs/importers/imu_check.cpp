#include "redbee/importers/imu_check.hpp"

#include <spdlog/fmt/fmt.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "redbee/geometry/median.hpp"
#include "redbee/importers/import.hpp"
#include "redbee/importers/impossible_values.hpp"
#include "redbee/importers/time_check.hpp"

namespace redbee {
namespace {

// m/s^2. The median of the specific force's length over a flight is near gravity's, 9.8, also in hard
// manoeuvres; another unit is off by a factor of nine at least.
constexpr double kLeastGravity = 6.5;
constexpr double kMostGravity = 14.5;
// Hz. No IMU that helps between two frames is slower or faster than these.
constexpr double kLeastRate = 20;
constexpr double kUsefulRate = 90;
constexpr double kMostRate = 20000;
/// Fewer samples than this show nothing.
constexpr size_t kFewSamples = 10;

bool isGravity(double length) { return length >= kLeastGravity && length <= kMostGravity; }

double medianPeriod_s(const std::vector<ImuSample>& imu) {
  std::vector<double> periods;
  for (size_t i = 1; i < imu.size(); ++i) periods.push_back(seconds(imu[i].time - imu[i - 1].time));
  return median(periods);
}

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

/// The first unit but `read_as` that fits; empty if none does. `factor`: from the values as they were read.
std::string firstUnit(const UnitTable& table, const std::string& read_as, const std::string& option,
                      const std::function<bool(double factor)>& fits) {
  const double read = factorOf(table, read_as, option);
  for (const auto& [name, factor] : table) {
    if (name != read_as && fits(factor / read)) return name;
  }
  return "";
}

void checkGravity(const std::vector<ImuSample>& imu, const ImuUnits& read_as, ImuFindings& findings) {
  std::vector<double> lengths;
  lengths.reserve(imu.size());
  for (const ImuSample& sample : imu) lengths.push_back(sample.accel.norm());
  const double length = median(lengths);
  if (isGravity(length)) return;
  const std::string what =
      fmt::format("the accelerometer's median length is {:.3g} m/s^2, not gravity's 9.8", length);
  const std::string unit = firstUnit(accelUnits(), read_as.accel, "--accel-unit",
                                     [&](double factor) { return isGravity(factor * length); });
  if (!unit.empty()) {
    findings.faults.push_back(what + ": it fits " + unit + ", give --accel-unit " + unit);
  } else if (length < kLeastGravity) {
    findings.faults.push_back(what +
                              ": a phone's \"linear acceleration\" leaves gravity out; record the raw "
                              "accelerometer, or import without the IMU");
  } else {
    findings.faults.push_back(what + ", in no known unit; import without the IMU");
  }
}

/// More of them than can be left out.
void checkPossible(const std::vector<ImuSample>& imu, ImuFindings& findings) {
  const auto wrong =
      std::count_if(imu.begin(), imu.end(), [](const ImuSample& sample) { return !isPossible(sample); });
  if (wrong == 0) return;
  findings.faults.push_back(
      fmt::format("{} of {} IMU samples are beyond what any measures, in no known unit: the recording is "
                  "damaged; import without the IMU",
                  wrong, imu.size()));
}

void checkTurns(const std::vector<ImuSample>& imu, const ImuUnits& read_as, ImuFindings& findings) {
  // Measured on fifteen recordings: below 10 degrees in the right unit, 13 to 87 where deg/s are read as
  // rad/s, and then at least 5 times the right unit's.
  constexpr double kDisagreement = 10 * M_PI / 180;
  constexpr double kRatio = 4;
  const double period_s = medianPeriod_s(imu);
  const auto now = turnDisagreement(imu, period_s, 1);
  if (!now || *now < kDisagreement) return;
  const std::string unit = firstUnit(gyroUnits(), read_as.gyro, "--gyro-unit", [&](double factor) {
    return *turnDisagreement(imu, period_s, factor) < *now / kRatio;
  });
  if (unit.empty()) return;
  findings.faults.push_back(fmt::format(
      "the gyro turns {:.0f} degrees away from the accelerometer's gravity within 0.2 s: it fits {}, give "
      "--gyro-unit {}",
      *now * 180 / M_PI, unit, unit));
}

void checkRate(const std::vector<ImuSample>& imu, double frames_s, const ImuUnits& read_as,
               ImuFindings& findings) {
  const double rate = 1 / medianPeriod_s(imu);
  const double span_s = seconds(imu.back().time - imu.front().time);
  if (rate >= kLeastRate && rate <= kMostRate) {
    if (rate < kUsefulRate)
      findings.warnings.push_back(
          fmt::format("the IMU has {:.3g} Hz, which is slow: 100 Hz or more are needed to "
                      "follow a drone between frames",
                      rate));
    return;
  }
  const auto off = [&](double span) { return std::abs(std::log(span / std::max(frames_s, 0.1))); };
  const std::string unit = firstUnit(timeUnits(), read_as.time, "--time-unit", [&](double factor) {
    const double other = rate / factor;
    return other >= kLeastRate && other <= kMostRate && off(span_s * factor) < off(span_s);
  });
  const std::string what =
      fmt::format("the IMU has {:.3g} Hz over {:.3g} s, the video lasts {:.3g} s", rate, span_s, frames_s);
  if (unit.empty()) {
    findings.warnings.push_back(what + ": 100 Hz or more are needed to follow a drone between frames");
  } else {
    findings.faults.push_back(what + ": its times fit " + unit + ", give --time-unit " + unit);
  }
}

void checkHoles(const std::vector<ImuSample>& imu, ImuFindings& findings) {
  // A sample or two may be lost; an interpolation over more misses a manoeuvre.
  const double tolerated_s = std::max(5 * medianPeriod_s(imu), 0.02);
  double longest_s = 0, at_s = 0;
  int count = 0;
  for (size_t i = 1; i < imu.size(); ++i) {
    const double hole_s = seconds(imu[i].time - imu[i - 1].time);
    if (hole_s <= tolerated_s) continue;
    ++count;
    if (hole_s <= longest_s) continue;
    longest_s = hole_s;
    at_s = seconds(imu[i - 1].time.time_since_epoch());
  }
  if (count == 0) return;
  if (longest_s > kClockWasSet_s) {
    findings.faults.push_back(
        fmt::format("the IMU's times leap by {:.0f} s after {:.3f} s: take out what leaps, or "
                    "cut the recording there",
                    longest_s, at_s));
    return;
  }
  findings.warnings.push_back(
      fmt::format("the IMU has {} hole{}, the longest of {:.3g} s at {:.3f} s: record it "
                  "with a larger buffer",
                  count, count == 1 ? "" : "s", longest_s, at_s));
}

void checkConstants(const std::vector<ImuSample>& imu, ImuFindings& findings) {
  const char* names[2][3] = {{"gx", "gy", "gz"}, {"ax", "ay", "az"}};
  std::string constant;
  for (int sensor = 0; sensor < 2; ++sensor) {
    const auto values = [sensor](const ImuSample& sample) {
      return sensor == 0 ? sample.gyro : sample.accel;
    };
    for (int axis = 0; axis < 3; ++axis) {
      const double first = values(imu.front())[axis];
      const bool same = std::all_of(imu.begin(), imu.end(),
                                    [&](const ImuSample& sample) { return values(sample)[axis] == first; });
      if (same)
        constant += fmt::format("{}{} = {:g}", constant.empty() ? "" : ", ", names[sensor][axis], first);
    }
  }
  if (constant.empty()) return;
  findings.warnings.push_back(
      "the IMU never changes: " + constant +
      "; a sensor that is alive has noise: check the columns, or import without the IMU");
}

}  // namespace

ImuFindings checkImu(const std::vector<ImuSample>& imu, CameraTime first_frame, CameraTime last_frame,
                     const ImuUnits& read_as) {
  ImuFindings findings;
  if (imu.empty()) return findings;
  if (imu.size() < kFewSamples) {
    findings.warnings.push_back(
        fmt::format("the IMU has {} sample{}, too few to be checked or flown with: import without the IMU",
                    imu.size(), imu.size() == 1 ? "" : "s"));
  } else {
    checkRate(imu, seconds(last_frame - first_frame), read_as, findings);
    checkGravity(imu, read_as, findings);
    // In a wrong unit of time the gyro's turns mean nothing.
    if (findings.faults.empty()) checkTurns(imu, read_as, findings);
    if (findings.faults.empty()) checkPossible(imu, findings);
    checkHoles(imu, findings);
    checkConstants(imu, findings);
  }
  const auto coverage = imuCoverageWarning(imu, first_frame, last_frame);
  if (!coverage) return findings;
  const bool covers_none =
      imu.front().time > toImu(last_frame, Duration(0)) || imu.back().time < toImu(first_frame, Duration(0));
  if (covers_none && imu.size() >= kFewSamples) {
    findings.faults.push_back(*coverage +
                              ": they must count on one clock, such as from the video's first frame");
  } else {
    findings.warnings.push_back(*coverage);
  }
  return findings;
}

}  // namespace redbee
