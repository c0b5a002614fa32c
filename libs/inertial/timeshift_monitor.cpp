#include "redbee/inertial/timeshift_monitor.hpp"

#include <cmath>
#include <cstdio>

#include "redbee/geometry/angle.hpp"
#include "redbee/geometry/so3.hpp"

namespace redbee {
namespace {

constexpr double kLongestPair_s = 0.5;  // frames further apart are not compared
constexpr double kClockSetBack_s =
    1;  // a pair that is older than so came from another clock; others came late
constexpr double kReach_s = TimeshiftFitOptions().max_shift_s + 0.05;
constexpr double kSigmas = 3;               // of certainty before anything is said
constexpr double kSmallestDrift_s = 0.003;  // a smaller change over the memory is no drift worth a word
constexpr size_t kMinForDrift = 3;

}  // namespace

double TimeshiftMonitor::sinceOrigin(ImuTime time) {
  if (!origin_) origin_ = time;
  return seconds(time - *origin_);
}

void TimeshiftMonitor::addGyro(ImuTime time, const Eigen::Vector3d& rate) {
  const double now_s = sinceOrigin(time);
  gyro_.add(now_s, rate);
  gyro_.eraseBefore(now_s - parameters_.window_s - kReach_s - kClockSetBack_s);  // also where vision is away
}

void TimeshiftMonitor::addVision(CameraTime a, CameraTime b, const Eigen::Matrix3d& R_ba) {
  const double duration_s = seconds(b - a);
  if (duration_s <= 0 || duration_s > kLongestPair_s || !R_ba.allFinite()) return;
  const Duration shift = fromSeconds(extrinsics_.timeshift_s);
  const double from_s = sinceOrigin(toImu(a, shift));
  const double to_s = sinceOrigin(toImu(b, shift));
  if (!vision_.empty() && to_s <= vision_.back().to_s) {  // the clock was set back, or a pair came late
    if (vision_.back().to_s - to_s < kClockSetBack_s) return;
    vision_.clear();
    past_.clear();
    updated_s_ = from_s;
  }
  // R_ba turns coordinates of a into those of b: against the camera's own rotation.
  vision_.push_back({from_s, to_s, extrinsics_.R_CI.transpose() * -logSO3(R_ba) / duration_s});
  while (vision_.front().from_s < to_s - parameters_.window_s) vision_.pop_front();
  gyro_.eraseBefore(to_s - parameters_.window_s - kReach_s);
  if (to_s - updated_s_ < parameters_.period_s) return;
  updated_s_ = to_s;
  update();
}

void TimeshiftMonitor::update() {
  estimate_.reset();
  if (vision_.back().to_s - vision_.front().from_s >= parameters_.min_span_s) {
    const auto fit = fitTimeshift({vision_.begin(), vision_.end()}, gyro_);
    if (fit && fit->sigma_s <= parameters_.max_sigma_s) estimate_ = fit;
  }
  if (estimate_) keepForDrift(vision_.back().to_s);
  describe();
}

void TimeshiftMonitor::keepForDrift(double now_s) {
  if (!past_.empty() && now_s - past_.back().time_s < parameters_.window_s) return;
  past_.push_back({now_s, *estimate_});
  while (past_.front().time_s < now_s - parameters_.drift_memory_s) past_.pop_front();
}

std::optional<TimeshiftMonitor::Drift> TimeshiftMonitor::drift() const {
  if (past_.size() < kMinForDrift) return std::nullopt;
  double weight = 0, t = 0, tt = 0, s = 0, ts = 0;
  for (const Past& each : past_) {
    const double w = 1 / (each.fit.sigma_s * each.fit.sigma_s);
    const double since = each.time_s - past_.front().time_s;
    weight += w;
    t += w * since;
    tt += w * since * since;
    s += w * each.fit.shift_s;
    ts += w * since * each.fit.shift_s;
  }
  const double spread = tt - t * t / weight;
  if (!(spread > 0)) return std::nullopt;
  return Drift{(ts - t * s / weight) / spread, 1 / std::sqrt(spread)};
}

double TimeshiftMonitor::rotation_deg_s() const {
  if (vision_.empty()) return 0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double squares = 0;
  for (const VisualRate& each : vision_) {
    sum += each.rate;
    squares += each.rate.squaredNorm();
  }
  const auto n = static_cast<double>(vision_.size());
  return std::sqrt(std::fmax(0, (squares - sum.squaredNorm() / n) / n)) / kDegree;
}

void TimeshiftMonitor::describe() {
  if (!estimate_) return;  // what the last estimate said is still the best
  const double off_s = std::abs(estimate_->shift_s);
  const double margin_s = kSigmas * estimate_->sigma_s;
  is_off_ = off_s - margin_s > parameters_.tolerance_s || (is_off_ && off_s > parameters_.tolerance_s);
  const auto drift = this->drift();
  const double span_s = past_.empty() ? 0 : past_.back().time_s - past_.front().time_s;
  const bool drifts = drift && std::abs(drift->rate) > kSigmas * drift->sigma &&
                      std::abs(drift->rate) * span_s > kSmallestDrift_s;
  message_.clear();
  if (!is_off_ && !drifts) return;
  char text[160];
  std::snprintf(text, sizeof text, "the stamps of camera and IMU are %.0f ms apart (sigma %.0f ms)",
                1e3 * off_s, std::ceil(1e3 * estimate_->sigma_s));
  message_ = text;
  if (drifts) {
    std::snprintf(text, sizeof text, " and drift by %.1f ms a minute", 60e3 * drift->rate);
    message_ += text;
  } else {
    std::snprintf(text, sizeof text, "; camera.timeshift_s: %.3f would fit",
                  extrinsics_.timeshift_s + estimate_->shift_s);
    message_ += text;
  }
}

}  // namespace redbee
