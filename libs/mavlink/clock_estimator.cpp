#include "redbee/mavlink/clock_estimator.hpp"

#include <algorithm>
#include <cmath>

namespace redbee::mavlink {
namespace {

constexpr size_t kWindow = 64;             // exchanges whose shortest delay is r_min; six seconds at 10 Hz
constexpr int kFewest = 5;                 // exchanges before times are given
constexpr double kStampSigma_s = 100e-6;   // of a sample with the shortest delay: interrupts, scheduling
constexpr double kGateFloor_s = 200e-6;    // delays that differ by less are alike
constexpr double kGateFraction = 0.5;      // of the shortest delay
constexpr double kDriftSigma = 100e-6;     // s/s, of a crystal before anything is known
constexpr double kPhaseNoise = 1e-12;      // s^2/s: a microsecond after a second
constexpr double kFrequencyNoise = 1e-14;  // (s/s)^2/s: a crystal that warms up by 1e-6 in 100 s
constexpr double kImpossible_sigmas = 5;
constexpr double kMaxDrift = 1e-3;  // s/s; no crystal is as bad, a clock that is being set may be

double secondsOf(int64_t ns) { return static_cast<double>(ns) * 1e-9; }
int64_t middleOf(const TimesyncExchange& e) { return e.sent_ns + (e.received_ns - e.sent_ns) / 2; }
double gateOf(double shortest_s) { return std::max(kGateFloor_s, kGateFraction * shortest_s); }

}  // namespace

double ClockEstimator::shortest() const {
  return *std::min_element(round_trips_s_.begin(), round_trips_s_.end());
}

void ClockEstimator::begin(const TimesyncExchange& exchange) {
  const double round_trip_s = secondsOf(exchange.received_ns - exchange.sent_ns);
  round_trips_s_ = {round_trip_s};
  used_ = 1;
  is_doubted_ = false;
  host_ns_ = middleOf(exchange);
  offset_ns_ = exchange.device_ns - host_ns_;
  x_.setZero();
  const double sigma = kStampSigma_s + round_trip_s / 2;
  P_ = Eigen::Vector2d(sigma * sigma, kDriftSigma * kDriftSigma).asDiagonal();
}

void ClockEstimator::predictTo(int64_t host_ns) {
  const double dt = std::max(secondsOf(host_ns - host_ns_), 0.0);
  Eigen::Matrix2d F = Eigen::Matrix2d::Identity();
  F(0, 1) = dt;
  // White noise of phase and frequency, integrated over dt.
  Eigen::Matrix2d Q;
  Q << kPhaseNoise * dt + kFrequencyNoise * dt * dt * dt / 3, kFrequencyNoise * dt * dt / 2,
      kFrequencyNoise * dt * dt / 2, kFrequencyNoise * dt;
  x_ = F * x_;
  P_ = F * P_ * F.transpose() + Q;
  host_ns_ = std::max(host_ns_, host_ns);
}

void ClockEstimator::correct(double innovation, double variance) {
  const Eigen::Vector2d gain = P_.col(0) / (P_(0, 0) + variance);
  x_ += gain * innovation;
  Eigen::Matrix2d A = Eigen::Matrix2d::Identity();
  A.col(0) -= gain;
  P_ = A * P_ * A.transpose() + gain * variance * gain.transpose();
  // Keep the state small, so that its double has digits to spare.
  const auto whole = static_cast<int64_t>(std::llround(x_(0) * 1e9));
  offset_ns_ += whole;
  x_(0) -= secondsOf(whole);
}

ClockEstimator::Outcome ClockEstimator::add(const TimesyncExchange& exchange) {
  const double round_trip_s = secondsOf(exchange.received_ns - exchange.sent_ns);
  if (used_ == 0) {
    begin(exchange);
    return Outcome::kUsed;
  }
  const int64_t host_ns = middleOf(exchange);
  const int64_t offset_ns = exchange.device_ns - host_ns;
  ClockEstimator predicted = *this;
  predicted.predictTo(host_ns);
  const double innovation = secondsOf(offset_ns - predicted.offset_ns_) - predicted.x_(0);
  const double sigma = std::sqrt(predicted.P_(0, 0)) + kStampSigma_s;
  const double earlier_s = shortest();
  // The estimate comes of exchanges that took up to a gate longer than the shortest.
  const double estimate_s = (earlier_s + gateOf(earlier_s)) / 2;
  if (std::abs(innovation) > round_trip_s / 2 + estimate_s + kImpossible_sigmas * sigma) {
    const bool agrees = is_doubted_ && std::abs(secondsOf(offset_ns - doubted_offset_ns_)) <
                                           round_trip_s + kImpossible_sigmas * kStampSigma_s;
    is_doubted_ = true;
    doubted_offset_ns_ = offset_ns;
    if (!agrees) return Outcome::kDoubted;
    begin(exchange);
    return Outcome::kRestarted;
  }
  is_doubted_ = false;
  round_trips_s_.push_back(round_trip_s);
  if (round_trips_s_.size() > kWindow) round_trips_s_.pop_front();
  const double excess = round_trip_s - shortest();
  if (excess > gateOf(shortest())) return Outcome::kSlow;
  predictTo(host_ns);
  // What the ways so far had in common, one direction longer than the other, no number of exchanges showed; a
  // shorter way does.
  if (round_trip_s < earlier_s) P_(0, 0) += (earlier_s - round_trip_s) * (earlier_s - round_trip_s) / 4;
  correct(innovation, kStampSigma_s * kStampSigma_s + excess * excess / 4);
  if (std::abs(x_(1)) > kMaxDrift) {
    begin(exchange);
    return Outcome::kRestarted;
  }
  ++used_;
  return Outcome::kUsed;
}

std::optional<int64_t> ClockEstimator::toHost(int64_t device_ns) const {
  if (used_ < kFewest || is_doubted_) return std::nullopt;
  const double since = (secondsOf(device_ns - offset_ns_ - host_ns_) - x_(0)) / (1 + x_(1));
  return host_ns_ + static_cast<int64_t>(std::llround(since * 1e9));
}

std::optional<ClockState> ClockEstimator::state() const {
  if (used_ < kFewest || is_doubted_) return std::nullopt;
  const double common = (shortest() + gateOf(shortest())) / 2;
  const double sigma_s = std::sqrt(P_(0, 0) + common * common / 3);
  return ClockState{host_ns_, offset_ns_, x_(1), sigma_s, shortest()};
}

}  // namespace redbee::mavlink
