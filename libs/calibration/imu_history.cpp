#include "redbee/calibration/imu_history.hpp"

#include <algorithm>

#include "redbee/geometry/so3.hpp"

namespace redbee::calibration {
namespace {

Eigen::Quaterniond turned(const Eigen::Quaterniond& attitude, const Eigen::Vector3d& rotation_vector) {
  return (attitude * Eigen::Quaterniond(expSO3(rotation_vector))).normalized();
}

}  // namespace

ImuHistory::ImuHistory(const std::vector<ImuSample>& samples, ImuTime origin) {
  samples_.reserve(samples.size());
  for (const ImuSample& sample : samples) {
    if (!sample.gyro.allFinite() || !sample.accel.allFinite()) continue;
    samples_.push_back({seconds(sample.time - origin), sample.gyro, sample.accel});
  }
  std::stable_sort(samples_.begin(), samples_.end(),
                   [](const Sample& a, const Sample& b) { return a.t_s < b.t_s; });
  const auto repeated = std::unique(samples_.begin(), samples_.end(),
                                    [](const Sample& a, const Sample& b) { return a.t_s == b.t_s; });
  samples_.erase(repeated, samples_.end());

  attitudes_.reserve(samples_.size());
  Eigen::Quaterniond attitude = Eigen::Quaterniond::Identity();
  for (size_t i = 0; i < samples_.size(); ++i) {
    if (i > 0) {
      const double dt = samples_[i].t_s - samples_[i - 1].t_s;
      attitude = turned(attitude, 0.5 * dt * (samples_[i].gyro + samples_[i - 1].gyro));
    }
    attitudes_.push_back(attitude);
  }
}

size_t ImuHistory::indexBefore(double t_s) const {
  const auto after = std::upper_bound(samples_.begin(), samples_.end(), t_s,
                                      [](double t, const Sample& sample) { return t < sample.t_s; });
  const auto index = std::max<ptrdiff_t>(after - samples_.begin() - 1, 0);
  return std::min(static_cast<size_t>(index), samples_.size() < 2 ? 0 : samples_.size() - 2);
}

bool ImuHistory::covers(double from_s, double to_s, double max_gap_s) const {
  if (samples_.size() < 2 || from_s < begin_s() || to_s > end_s()) return false;
  for (size_t i = indexBefore(from_s); i + 1 < samples_.size() && samples_[i].t_s < to_s; ++i) {
    if (samples_[i + 1].t_s - samples_[i].t_s > max_gap_s) return false;
  }
  return true;
}

ImuHistory::Sample ImuHistory::at(double t_s) const {
  const size_t i = indexBefore(t_s);
  const Sample& before = samples_[i];
  const Sample& after = samples_[std::min(i + 1, samples_.size() - 1)];
  const double span = after.t_s - before.t_s;
  const double fraction = span > 0 ? std::clamp((t_s - before.t_s) / span, 0.0, 1.0) : 0.0;
  return {t_s, before.gyro + fraction * (after.gyro - before.gyro),
          before.accel + fraction * (after.accel - before.accel)};
}

std::vector<ImuHistory::Sample> ImuHistory::between(double from_s, double to_s) const {
  std::vector<Sample> span{at(from_s)};
  for (size_t i = indexBefore(from_s); i < samples_.size() && samples_[i].t_s < to_s; ++i) {
    if (samples_[i].t_s > from_s) span.push_back(samples_[i]);
  }
  span.push_back(at(to_s));
  return span;
}

Eigen::Quaterniond ImuHistory::attitudeAt(double t_s) const {
  const double t = std::clamp(t_s, begin_s(), end_s());
  const size_t i = indexBefore(t);
  return turned(attitudes_[i], 0.5 * (t - samples_[i].t_s) * (samples_[i].gyro + at(t).gyro));
}

Eigen::Matrix3d ImuHistory::rotation(double a_s, double b_s) const {
  return (attitudeAt(a_s).conjugate() * attitudeAt(b_s)).toRotationMatrix();
}

Eigen::Vector3d ImuHistory::meanRate(double a_s, double b_s) const {
  return logSO3(rotation(a_s, b_s)) / (b_s - a_s);
}

}  // namespace redbee::calibration
