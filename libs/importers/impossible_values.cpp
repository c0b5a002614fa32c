#include "redbee/importers/impossible_values.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "redbee/geometry/time.hpp"

namespace redbee {
namespace {

// Ten times what the IMUs of vehicles measure, and far below what the bits of a damaged float mostly make.
constexpr double kMostTurn = 200;    // rad/s
constexpr double kMostForce = 2000;  // m/s^2
constexpr double kMostHeight = 2e4;  // m

template <typename Sample>
std::string leaveOut(std::vector<Sample>& samples, double most_of_all, const char* what, const char* limits) {
  const auto isWrong = [](const Sample& sample) { return !isPossible(sample); };
  const auto first = std::find_if(samples.begin(), samples.end(), isWrong);
  const auto wrong = std::count_if(first, samples.end(), isWrong);
  const size_t all = samples.size();
  if (wrong == 0 || static_cast<double>(wrong) > most_of_all * static_cast<double>(all)) return "";
  const double first_s = seconds(first->time.time_since_epoch());
  samples.erase(std::remove_if(first, samples.end(), isWrong), samples.end());
  return fmt::format(
      "{} of {} {} are beyond what any measures ({}), the first at {:.3f} s: they are left out; the "
      "recording "
      "is damaged there",
      wrong, all, what, limits, first_s);
}

}  // namespace

// Comparisons that are false for NaN.
bool isPossibleTurn(const Eigen::Vector3d& gyro) { return gyro.norm() <= kMostTurn; }
bool isPossibleForce(const Eigen::Vector3d& accel) { return accel.norm() <= kMostForce; }

bool isPossible(const ImuSample& sample) {
  return isPossibleTurn(sample.gyro) && isPossibleForce(sample.accel);
}

bool isPossible(const AltitudeSample& sample) {
  return std::abs(sample.height_m) <= kMostHeight && sample.sigma_m > 0 && std::isfinite(sample.sigma_m);
}

std::string leaveOutImpossible(std::vector<ImuSample>& imu) {
  return leaveOut(imu, kMostImpossible, "IMU samples", "200 rad/s, 2000 m/s^2");
}

std::string leaveOutImpossible(std::vector<AltitudeSample>& altitudes) {
  return leaveOut(altitudes, 1, "altitudes", "20 km");
}

}  // namespace redbee
