#include "redbee/importers/gravity.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "redbee/geometry/median.hpp"

namespace redbee {
namespace {

// m/s^2. What a drone's manoeuvres and the filters of accelerometers leave of 9.8, generously.
constexpr double kLeastGravity = 6.5;
constexpr double kMostGravity = 14.5;
// s. Long against shaking, and so that a change of velocity by 10 m/s adds less than a tenth; short enough
// for a gyro's bias.
constexpr double kWindow_s = 4;
constexpr double kShortestWindow_s = 1;
// s. Over a longer hole the attitude is not known.
constexpr double kHole_s = 0.1;

/// The specific force of samples in a row, in the attitude of the first.
class Window {
 public:
  double duration_s() const { return duration_s_; }
  double meanForce() const { return sum_.norm() / duration_s_; }

  void add(const ImuSample& from, double period_s, double gyro_scale) {
    sum_ += period_s * (attitude_ * from.accel);
    duration_s_ += period_s;
    const Eigen::Vector3d angle = gyro_scale * period_s * from.gyro;
    const double length = angle.norm();
    if (length > 0) attitude_ = attitude_ * Eigen::Quaterniond(Eigen::AngleAxisd(length, angle / length));
  }

 private:
  Eigen::Quaterniond attitude_ = Eigen::Quaterniond::Identity();
  Eigen::Vector3d sum_ = Eigen::Vector3d::Zero();  // m/s
  double duration_s_ = 0;
};

}  // namespace

bool isGravity(double length) { return length >= kLeastGravity && length <= kMostGravity; }

double medianForce(const std::vector<ImuSample>& imu) {
  std::vector<double> lengths;
  lengths.reserve(imu.size());
  for (const ImuSample& sample : imu) lengths.push_back(sample.accel.norm());
  return median(lengths);
}

std::optional<double> meanGravity(const std::vector<ImuSample>& imu, double gyro_scale) {
  std::vector<double> lengths;
  Window window;
  const auto end = [&] {
    if (window.duration_s() >= kShortestWindow_s) lengths.push_back(window.meanForce());
    window = {};
  };
  for (size_t i = 0; i + 1 < imu.size(); ++i) {
    const double period_s = seconds(imu[i + 1].time - imu[i].time);
    if (period_s > kHole_s) {
      end();
      continue;
    }
    window.add(imu[i], period_s, gyro_scale);
    if (window.duration_s() >= kWindow_s) end();
  }
  end();
  if (lengths.empty()) return std::nullopt;
  return median(lengths);
}

}  // namespace redbee
