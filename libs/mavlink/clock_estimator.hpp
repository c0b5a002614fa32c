// The autopilot's clock on ours, from exchanges of TIMESYNC.
//
// An exchange is sent at t1 and received at t4 on our clock, and answered at tau on the device's. With delays
// d1 there and d2 back, the offset theta = device - ours at the middle of t1 and t4 is
//     z = tau - (t1 + t4) / 2 = theta + (d1 - d2) / 2,     r = t4 - t1 = d1 + d2,
// so that its error is at most r / 2, and of a sample whose r exceeds the shortest r_min by e, what is not
// common to all samples is at most e / 2. State: theta [s] and its rate (drift), with white noise of phase
// and of frequency; z corrects it with variance sigma_0^2 + (e / 2)^2. Samples with e above a gate g are left
// out. What is common to all samples, an asymmetry of the shortest way, no exchange shows: it lies within
// +-(r_min + g) / 2, and a third of the square of that is added to the variance that is published (uniform
// distribution).
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

namespace redbee::mavlink {

/// Times from 0 to kMaxTime_ns, so that no difference overflows.
struct TimesyncExchange {
  static constexpr int64_t kMaxTime_ns = 4'000'000'000'000'000'000;  ///< the year 2096
  int64_t sent_ns = 0;                                               ///< our clock
  int64_t device_ns = 0;
  int64_t received_ns = 0;  ///< our clock
};

struct ClockState {
  int64_t host_ns = 0;      ///< our clock: the middle of the newest exchange that was used
  int64_t offset_ns = 0;    ///< device - ours, then
  double drift = 0;         ///< s/s, how much faster the device's clock runs
  double sigma_s = 0;       ///< of the offset, with what no exchange shows
  double round_trip_s = 0;  ///< the shortest of late
};

class ClockEstimator {
 public:
  enum class Outcome {
    kUsed,
    kSlow,      ///< its delay says that it would be worse than others
    kDoubted,   ///< contradicts the estimate by more than its delay can explain: perhaps the clock was set
    kRestarted  ///< the second in a row: it was set, as by a reboot
  };
  /// Precondition: sent_ns <= received_ns, in order of receipt.
  Outcome add(const TimesyncExchange& exchange);
  /// Forgets everything.
  void restart() { *this = {}; }

  /// The device's time on our clock; std::nullopt before the fifth exchange that was used, and in doubt.
  std::optional<int64_t> toHost(int64_t device_ns) const;
  std::optional<ClockState> state() const;

 private:
  void begin(const TimesyncExchange& exchange);
  void predictTo(int64_t host_ns);
  void correct(double innovation, double variance);
  double shortest() const;

  std::deque<double> round_trips_s_;  ///< of the latest exchanges
  int used_ = 0;
  bool is_doubted_ = false;
  int64_t doubted_offset_ns_ = 0;
  int64_t host_ns_ = 0;                          ///< of the state
  int64_t offset_ns_ = 0;                        ///< what x_ counts from, so that doubles hold small numbers
  Eigen::Vector2d x_ = Eigen::Vector2d::Zero();  ///< s, s/s
  Eigen::Matrix2d P_ = Eigen::Matrix2d::Zero();
};

}  // namespace redbee::mavlink
