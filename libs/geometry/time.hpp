// Times on the camera's and on the IMU's clock, as types that cannot be confused.
#pragma once

#include <chrono>
#include <cmath>
#include <cstdint>

namespace redbee {

/// Times and their differences are counted in whole microseconds.
using Duration = std::chrono::duration<int64_t, std::micro>;

/// Tags of the two clocks. They have no now(): times come from messages only.
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

/// Conversion from and to times in messages and files, which are microseconds [us]:
/// CameraTime(fromUtime(m.utime)).
constexpr Duration fromUtime(int64_t us) { return Duration(us); }
template <typename Clock>
constexpr int64_t toUtime(std::chrono::time_point<Clock, Duration> t) {
  return t.time_since_epoch().count();
}
/// From nanoseconds [ns], rounded to the nearest microsecond; truncation would shift frames by half a
/// microsecond on average against the IMU's samples.
constexpr Duration fromNanoseconds(int64_t ns) {
  const int64_t rest = ns % 1000;  // rounding before the division could overflow
  return Duration(ns / 1000 + (rest >= 500 ? 1 : 0) - (rest <= -500 ? 1 : 0));
}

/// In seconds [s].
constexpr double seconds(Duration d) { return static_cast<double>(d.count()) * 1e-6; }
/// From seconds [s], rounded to the nearest microsecond.
inline Duration fromSeconds(double s) { return Duration(std::llround(s * 1e6)); }

/// Times beyond this come from damaged messages; within it differences cannot overflow.
constexpr Duration kMaxTime{4'000'000'000'000'000'000};
template <typename Clock>
constexpr bool isPlausibleTime(std::chrono::time_point<Clock, Duration> t) {
  return t.time_since_epoch() > -kMaxTime && t.time_since_epoch() < kMaxTime;
}

}  // namespace redbee
