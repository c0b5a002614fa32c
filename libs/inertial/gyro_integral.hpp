// The gyro's samples of the last seconds, summed up, so that the mean rate between any two times is cheap.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <deque>

namespace redbee {

/// Times are seconds since an origin that the caller keeps. Rates are linear between the samples; rotations
/// about changing axes are summed as vectors, which is right to a part in a thousand within a frame's time.
class GyroIntegral {
 public:
  static constexpr double kMaxGap_s = 0.1;  ///< a longer time without samples begins the history anew

  /// Samples that are not later than the one before are left out.
  void add(double time_s, const Eigen::Vector3d& rate) {
    if (!knots_.empty()) {
      const double step_s = time_s - knots_.back().time_s;
      if (step_s <= 0 && step_s > -kMaxGap_s) return;
      if (step_s <= 0 || step_s > kMaxGap_s) knots_.clear();
    }
    const Eigen::Vector3d angle =
        knots_.empty() ? Eigen::Vector3d(Eigen::Vector3d::Zero())
                       : Eigen::Vector3d(knots_.back().angle +
                                         0.5 * (time_s - knots_.back().time_s) * (rate + knots_.back().rate));
    knots_.push_back({time_s, rate, angle});
  }
  void eraseBefore(double time_s) {
    while (knots_.size() > 2 && knots_[1].time_s < time_s) knots_.pop_front();
  }
  bool covers(double from_s, double to_s) const {
    return knots_.size() > 1 && knots_.front().time_s <= from_s && to_s <= knots_.back().time_s;
  }

  /// Mean rate on [from, to] [rad/s]. Precondition of both: covered.
  Eigen::Vector3d meanRate(double from_s, double to_s) const {
    return (at(to_s).angle - at(from_s).angle) / (to_s - from_s);
  }
  /// By how much that mean changes where both times are later by a second [rad/s^2].
  Eigen::Vector3d meanAcceleration(double from_s, double to_s) const {
    return (at(to_s).rate - at(from_s).rate) / (to_s - from_s);
  }

 private:
  struct Knot {
    double time_s;
    Eigen::Vector3d rate;
    Eigen::Vector3d angle;  ///< integral of the rate since the first knot that ever was
  };

  Knot at(double time_s) const {
    const auto after = std::lower_bound(knots_.begin() + 1, knots_.end() - 1, time_s,
                                        [](const Knot& knot, double t) { return knot.time_s < t; });
    const Knot& a = *(after - 1);
    const double step_s = time_s - a.time_s;
    const Eigen::Vector3d rate = a.rate + step_s / (after->time_s - a.time_s) * (after->rate - a.rate);
    return {time_s, rate, a.angle + 0.5 * step_s * (a.rate + rate)};
  }

  std::deque<Knot> knots_;
};

}  // namespace redbee
