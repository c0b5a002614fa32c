// Publishes the endless flight at `speed` times real time, like the drivers of a vehicle.
#pragma once

#include <chrono>

#include "tests/support/endless_flight.hpp"
#include "tests/support/sensor_messages.hpp"

namespace redbee::test {

class LivePlayer {
 public:
  using Clock = std::chrono::steady_clock;

  LivePlayer(Bus& bus, const EndlessFlight& flight, double longest_s, double speed = 1)
      : bus_(bus), flight_(flight), speed_(speed) {
    const simulation::Scenario& s = flight.scenario();
    imu_ = simulation::simulateImu(s.trajectory, 0, longest_s, ImuTime(s.start), s.imu);
    altitudes_ = simulation::simulateAltimeter(s.trajectory, s.extrinsics, 0, longest_s, ImuTime(s.start),
                                               s.altimeter.rate_hz, s.altimeter.sigma_m, s.altimeter.seed);
  }

  /// Publishes all messages due by now.
  void publishDue() {
    const std::chrono::duration<double, std::micro> elapsed = Clock::now() - start_;
    const Duration until =
        flight_.scenario().start + Duration(static_cast<int64_t>(elapsed.count() * speed_));
    for (; imu_at_ < imu_.size() && imu_[imu_at_].time <= ImuTime(until); ++imu_at_)
      bus_.publish("IMU", message(imu_[imu_at_]));
    for (; altitude_at_ < altitudes_.size() && altitudes_[altitude_at_].time <= ImuTime(until);
         ++altitude_at_) {
      bus_.publish("ALTIMETER", message(altitudes_[altitude_at_]));
    }
    for (; fromUtime(flight_.utime(frame_)) <= until; ++frame_) {
      bus_.publish("CAMERA", rawGreyMessage(flight_.utime(frame_), flight_.image(frame_)));
    }
  }

  int64_t newestUtime() const { return flight_.utime(frame_ - 1); }
  int64_t frames() const { return frame_; }
  bool isOver() const { return imu_at_ >= imu_.size(); }

 private:
  Bus& bus_;
  const EndlessFlight& flight_;
  double speed_;
  std::vector<ImuSample> imu_;
  std::vector<AltitudeSample> altitudes_;
  size_t imu_at_ = 0;
  size_t altitude_at_ = 0;
  int64_t frame_ = 0;
  Clock::time_point start_ = Clock::now();
};

}  // namespace redbee::test
