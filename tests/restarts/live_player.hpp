// Publishes the endless flight at its own speed, or so many times faster, as a vehicle's drivers would.
#pragma once

#include <chrono>

#include "redbee/altimeter_t.hpp"
#include "redbee/bus/bus.hpp"
#include "redbee/bus/image.hpp"
#include "redbee/image_t.hpp"
#include "redbee/ins_t.hpp"
#include "tests/restarts/looped_flight.hpp"

namespace redbee::test {

class LivePlayer {
 public:
  using Clock = std::chrono::steady_clock;

  LivePlayer(Bus& bus, const LoopedFlight& flight, double longest_s, double speed = 1)
      : bus_(bus), flight_(flight), speed_(speed) {
    const simulation::Scenario& s = flight.scenario();
    imu_ = simulation::simulateImu(s.trajectory, 0, longest_s, s.start_utime, s.imu);
    altitudes_ = simulation::simulateAltimeter(s.trajectory, s.extrinsics, 0, longest_s, s.start_utime,
                                               s.altimeter.rate_hz, s.altimeter.sigma_m, s.altimeter.seed);
  }

  /// Everything that is due by now.
  void publishDue() {
    const std::chrono::duration<double, std::micro> elapsed = Clock::now() - start_;
    const int64_t until = flight_.scenario().start_utime + static_cast<int64_t>(elapsed.count() * speed_);
    for (; imu_at_ < imu_.size() && imu_[imu_at_].utime <= until; ++imu_at_) publish(imu_[imu_at_]);
    for (; altitude_at_ < altitudes_.size() && altitudes_[altitude_at_].utime <= until; ++altitude_at_) {
      const AltitudeSample& sample = altitudes_[altitude_at_];
      bus_.publish("ALTIMETER", altimeter_t{sample.utime, sample.height_m, sample.sigma_m});
    }
    for (; flight_.utime(frame_) <= until; ++frame_) {
      bus_.publish("CAMERA", rawGreyMessage(flight_.utime(frame_), flight_.image(frame_)));
    }
  }

  int64_t newestUtime() const { return flight_.utime(frame_ - 1); }
  int64_t frames() const { return frame_; }
  bool isOver() const { return imu_at_ >= imu_.size(); }

 private:
  void publish(const ImuSample& sample) {
    ins_t message{};
    message.utime = sample.utime;
    for (int i = 0; i < 3; ++i) {
      message.gyro[i] = sample.gyro(i);
      message.accel[i] = sample.accel(i);
    }
    bus_.publish("IMU", message);
  }

  Bus& bus_;
  const LoopedFlight& flight_;
  double speed_;
  std::vector<ImuSample> imu_;
  std::vector<AltitudeSample> altitudes_;
  size_t imu_at_ = 0;
  size_t altitude_at_ = 0;
  int64_t frame_ = 0;
  Clock::time_point start_ = Clock::now();
};

}  // namespace redbee::test
