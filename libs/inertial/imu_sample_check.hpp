// Refuses implausible IMU samples of a faulty sensor.
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "redbee/geometry/time.hpp"
#include "redbee/inertial/imu.hpp"

namespace redbee {

struct ImuSampleLimits {
  double gyro_range = 34.9;  ///< rad/s: the gyro saturates here (usual: 2000 deg/s)
  double accel_range = 157;  ///< m/s^2: the accelerometer saturates here (usual: 16 g)
};

/// Classifies samples in the order of arrival:
///   saturated: a component reaches its sensor's range;
///   stuck: all three components of a sensor are exactly constant for kStuckFor_s, which noise rules out;
///   spike: far from the previous sample, and the next one is back. A sample that is far is held back until
///   the next one decides: the start of a manoeuvre is followed by more of it and accepted. "Far" scales with
///   the usual difference of neighbouring samples, so that a vibrating airframe is not taken for spikes.
class ImuSampleCheck {
 public:
  static constexpr double kStuckFor_s = 0.05;
  static constexpr int kStuckSamples = 5;  ///< at least

  explicit ImuSampleCheck(const ImuSampleLimits& limits) : limits_(limits) {}

  /// Samples accepted now, in order: none, this one, or one that was held back and this one.
  std::vector<ImuSample> filter(const ImuSample& sample);
  /// Samples on (begin, end] that were refused.
  int refusedOn(ImuTime begin, ImuTime end) const;
  void eraseBefore(ImuTime time);

 private:
  /// One sensor's three components.
  struct Channel {
    double floor;      ///< smaller differences are never spikes
    double usual = 0;  ///< running mean of differences between neighbours
    ImuTime same_since{};
    int same_count = 0;
    double limit() const;
    void note(double difference);
    bool isStuck(bool same, ImuTime time);
  };

  bool isSaturated(const ImuSample& sample) const;
  bool isStuck(const ImuSample& sample);
  /// Difference in units of the limit; above 1 is far.
  double distance(const ImuSample& a, const ImuSample& b) const;
  void acceptOrHold(const ImuSample& sample, std::vector<ImuSample>& accepted);
  void startAt(const ImuSample& sample);
  bool isRefused(ImuTime time) const;
  void refuse(ImuTime time);

  ImuSampleLimits limits_;
  Channel gyro_{0.5};                  // rad/s
  Channel accel_{5.0};                 // m/s^2
  std::optional<ImuSample> previous_;  ///< the last to arrive, accepted or not
  std::optional<ImuSample> accepted_;
  std::optional<ImuSample> held_;
  std::deque<ImuTime> refused_;
};

}  // namespace redbee
