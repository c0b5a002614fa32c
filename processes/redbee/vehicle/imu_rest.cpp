#include "processes/redbee/vehicle/imu_rest.hpp"

#include <algorithm>
#include <cmath>

namespace redbee {
namespace {

constexpr double kNoiseSpan_s = 0.1;
constexpr double kRestSpan_s = 0.5;
constexpr double kMinSeconds = 3;
constexpr double kStillRate = 0.005;  // rad/s, 0.3 deg/s: a vehicle in the hand turns more
constexpr double kStillAccel = 0.05;  // m/s^2
constexpr double kNoiseMargin = 10;   // times the expected density that is still no motion
constexpr size_t kMinBlock = 5;       // samples

using Vectors = std::vector<Eigen::Vector3d>;

/// Means over spans; one with fewer than kMinBlock samples is left out.
template <typename Value>
Vectors blockMeans(const std::vector<ImuSample>& samples, double span_s, const Value& value) {
  Vectors means;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  size_t count = 0;
  int64_t block = 0;
  for (const ImuSample& sample : samples) {
    const auto here = static_cast<int64_t>(seconds(sample.time - samples.front().time) / span_s);
    if (here != block) {
      if (count >= kMinBlock) means.push_back(sum / static_cast<double>(count));
      sum.setZero();
      count = 0;
      block = here;
    }
    sum += value(sample);
    ++count;
  }
  return means;
}

double deviation(const Vectors& values) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero(), squares = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& v : values) {
    sum += v;
    squares += v.cwiseProduct(v);
  }
  const auto n = static_cast<double>(values.size());
  const Eigen::Vector3d variance = (squares - sum.cwiseProduct(sum) / n) / n;
  return std::sqrt(std::max(0.0, variance.maxCoeff()));
}

double density(const Vectors& means) {
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();
  for (size_t i = 1; i < means.size(); ++i) {
    const Eigen::Vector3d step = means[i] - means[i - 1];
    squares += step.cwiseProduct(step);
  }
  const double variance = squares.maxCoeff() / (2 * static_cast<double>(means.size() - 1));
  return std::sqrt(variance * kNoiseSpan_s);
}

}  // namespace

RestReport restNoise(const std::vector<ImuSample>& samples, const ImuNoise& expected) {
  RestReport report;
  if (samples.size() < 2) return report;
  const double span_s = seconds(samples.back().time - samples.front().time);
  const auto gyro = [](const ImuSample& s) { return s.gyro; };
  const auto accel = [](const ImuSample& s) { return s.accel; };
  const Vectors rates = blockMeans(samples, kRestSpan_s, gyro);
  const Vectors forces = blockMeans(samples, kRestSpan_s, accel);
  const Vectors fine = blockMeans(samples, kNoiseSpan_s, gyro);
  if (span_s < kMinSeconds || rates.size() < 3 || fine.size() < 20) return report;
  report.turning = deviation(rates);
  const double noise = kNoiseMargin / std::sqrt(kRestSpan_s);
  const bool is_still = report.turning < std::max(kStillRate, noise * expected.gyro_noise_density) &&
                        deviation(forces) < std::max(kStillAccel, noise * expected.accel_noise_density);
  report.status = is_still ? RestStatus::kAtRest : RestStatus::kMoves;
  if (is_still) {
    report.noise = RestNoise{density(fine), density(blockMeans(samples, kNoiseSpan_s, accel)), span_s};
  }
  return report;
}

}  // namespace redbee
