// Times on the camera's and on the IMU's clock, as types that cannot be mixed up.
#pragma once

#include <chrono>
#include <cmath>
#include <cstdint>

namespace redbee {

/// Times and their differences are counted in whole microseconds.
using Duration = std::chrono::duration<int64_t, std::micro>;

/// Tags of the two clocks. Neither can be read: times come from messages alone.
struct CameraClock {
  using duration = Duration;
};
struct ImuClock {
  using duration = Duration;
};

/// Exposure of a frame on the camera's clock.
using CameraTime = std::chrono::time_point<CameraClock, Duration>;
/// Measurement of the IMU or the altimeter on the IMU's clock.
using ImuTime = std::chrono::time_point<ImuClock, Duration>;

/// t_imu = t_cam + timeshift (Kalibr's sign).
constexpr ImuTime toImu(CameraTime t, Duration timeshift) {
  return ImuTime(t.time_since_epoch() + timeshift);
}
constexpr CameraTime toCamera(ImuTime t, Duration timeshift) {
  return CameraTime(t.time_since_epoch() - timeshift);
}

/// The border to messages and files, whose times are counts of microseconds [us]:
/// CameraTime(fromUtime(m.utime)).
constexpr Duration fromUtime(int64_t us) { return Duration(us); }
template <typename Clock>
constexpr int64_t toUtime(std::chrono::time_point<Clock, Duration> t) {
  return t.time_since_epoch().count();
}
/// From nanoseconds [ns], to the nearest microsecond: periods of 24 Hz are no whole microseconds, and
/// truncating would shift every frame by half a microsecond on average against the IMU's samples.
constexpr Duration fromNanoseconds(int64_t ns) {
  const int64_t rest = ns % 1000;  // rounding before the division could overflow
  return Duration(ns / 1000 + (rest >= 500 ? 1 : 0) - (rest <= -500 ? 1 : 0));
}

/// s, as the equations use it.
constexpr double seconds(Duration d) { return static_cast<double>(d.count()) * 1e-6; }
/// From seconds [s], to the nearest microsecond.
inline Duration fromSeconds(double s) { return Duration(std::llround(s * 1e6)); }

/// Times beyond this are damaged; within it, differences cannot overflow.
constexpr Duration kMaxTime{4'000'000'000'000'000'000};
template <typename Clock>
constexpr bool isPlausibleTime(std::chrono::time_point<Clock, Duration> t) {
  return t.time_since_epoch() > -kMaxTime && t.time_since_epoch() < kMaxTime;
}

}  // namespace redbee
