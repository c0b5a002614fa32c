#include "redbee/inertial/vision_agreement.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "redbee/geometry/chi_square.hpp"
#include "redbee/geometry/small_decompositions.hpp"
#include "redbee/geometry/so3.hpp"

namespace redbee {
namespace {

constexpr double kHistory_s = 4;
constexpr double kMaxPair_s = 0.5;          // frames further apart are not compared
constexpr double kContradictionWeight = 4;  // of a contradicting pair while they disagree: four of five agree
constexpr double kGross = 4;                // squared ratio of a pair that counts twice
constexpr double kMaxLag_s = 1;
constexpr double kLagStep_s = 0.01;
constexpr double kMinOverlap_s = 1;
/// An offset explains the rotations if it leaves less of their difference's variance.
constexpr double kUnexplained = 0.2;
constexpr double kDescribe_s = 1;

}  // namespace

std::string disagreementOf(double clock_offset_s) {
  char text[120];
  std::snprintf(text, sizeof text, "IMU and camera disagree: the camera's clock is about %.2f s %s",
                std::abs(clock_offset_s), clock_offset_s > 0 ? "ahead" : "behind");
  return text;
}

VisionAgreement::VisionAgreement(const Parameters& parameters)
    : parameters_(parameters), gate_(chiSquareQuantile(parameters.probability, 3)) {}

void VisionAgreement::note(const ComparedRotation& pair) {
  const double duration = seconds(pair.time - pair.time_previous);
  const bool in_order = !last_ || pair.time > *last_;
  if (!in_order || duration <= 0 || duration > kMaxPair_s) return;
  if (!first_) first_ = pair.time;
  const Eigen::Vector3d rate = logSO3(pair.R_ba) / duration;
  // By how much the rotation of the pair changes with an offset of the clocks [rad/s].
  const bool follows = last_ && *last_ == pair.time_previous && !history_.empty();
  const Eigen::Vector3d by_offset =
      follows ? Eigen::Vector3d(rate - history_.back().inertial) : Eigen::Vector3d(Eigen::Vector3d::Zero());
  const Eigen::Matrix3d by_mounting = Eigen::Matrix3d::Identity() - pair.R_ba;
  const double mounting = parameters_.mounting_sigma * parameters_.mounting_sigma;
  const double timeshift = parameters_.timeshift_sigma_s * parameters_.timeshift_sigma_s;
  const Eigen::Matrix3d in_time =
      pair.difference.covariance + mounting * by_mounting * by_mounting.transpose();
  const Eigen::Matrix3d covariance = in_time + timeshift * by_offset * by_offset.transpose();

  const double squared = squaredMahalanobis(pair.difference.difference, covariance);
  const double offset_squared = squaredMahalanobis(parameters_.visible_offset_s * by_offset, in_time);
  last_ = pair.time;
  if (!std::isfinite(squared) || !std::isfinite(offset_squared)) return;
  keep({seconds(pair.time - *first_) - duration / 2, duration, rate,
        rate + pair.difference.difference / duration});
  decide(squared / gate_, offset_squared > gate_, duration);
  describe();
}

void VisionAgreement::keep(const Rates& rates) {
  history_.push_back(rates);
  while (history_.front().time_s < rates.time_s - kHistory_s) history_.pop_front();
}

void VisionAgreement::decide(double squared_ratio, bool offset_is_visible, double duration_s) {
  const bool contradicts = squared_ratio > 1;
  if (agrees_) {
    double step_s = -duration_s;
    if (contradicts) step_s = squared_ratio > kGross ? 2 * duration_s : duration_s;
    contradicted_s_ = std::max(0.0, contradicted_s_ + step_s);
    agrees_ = contradicted_s_ < parameters_.disagreement_s;
    confirmed_s_ = 0;
    return;
  }
  if (contradicts) {
    confirmed_s_ = std::max(0.0, confirmed_s_ - kContradictionWeight * duration_s);
  } else if (offset_is_visible) {
    confirmed_s_ += duration_s;
  }
  agrees_ = confirmed_s_ >= parameters_.agreement_s;
  if (agrees_) contradicted_s_ = 0;
}

void VisionAgreement::describe() {
  if (agrees_) return message_.clear();
  const double now_s = history_.back().time_s;
  if (!message_.empty() && now_s - described_at_s_ < kDescribe_s) return;
  described_at_s_ = now_s;
  const std::optional<double> offset = clockOffset();
  if (!offset && !message_.empty()) return;  // what the last estimate said is still the best
  message_ =
      offset ? disagreementOf(*offset) : "IMU and camera disagree: rotations differ, clocks or mounting?";
}

namespace {

/// Of a vector over time.
class Variance {
 public:
  void add(const Eigen::Vector3d& value, double weight) {
    squares_ += weight * value.squaredNorm();
    sum_ += weight * value;
    weight_ += weight;
  }
  double weight() const { return weight_; }
  double value() const { return (squares_ - sum_.squaredNorm() / weight_) / weight_; }

 private:
  double squares_ = 0;
  double weight_ = 0;
  Eigen::Vector3d sum_ = Eigen::Vector3d::Zero();
};

}  // namespace

/// Variance of visual(t) - inertial(t + lag), linear between the pairs' middles, over that without a lag at
/// the same times: what is left of quiet seconds explains nothing. A gyro's bias is the same at each lag.
std::optional<double> VisionAgreement::unexplained(double lag_s) const {
  Variance with;
  Variance without;
  size_t next = 1;
  for (const Rates& at : history_) {
    const double time = at.time_s + lag_s;
    while (next < history_.size() && history_[next].time_s < time) ++next;
    if (next >= history_.size()) break;
    const Rates& a = history_[next - 1];
    const Rates& b = history_[next];
    if (time < a.time_s) continue;
    const double part = (time - a.time_s) / (b.time_s - a.time_s);
    with.add(at.visual - (1 - part) * a.inertial - part * b.inertial, at.duration_s);
    without.add(at.visual - at.inertial, at.duration_s);
  }
  if (with.weight() < kMinOverlap_s || !(without.value() > 0)) return std::nullopt;
  return with.value() / without.value();
}

std::optional<double> VisionAgreement::clockOffset() const {
  double least = kUnexplained;
  std::optional<double> offset_s;
  const int steps = static_cast<int>(std::round(kMaxLag_s / kLagStep_s));
  for (int i = -steps; i <= steps; ++i) {
    const std::optional<double> part = unexplained(i * kLagStep_s);
    if (!part || *part >= least) continue;
    least = *part;
    offset_s = -i * kLagStep_s;
  }
  return offset_s;
}

}  // namespace redbee
