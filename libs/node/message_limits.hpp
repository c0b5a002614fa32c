// Limits of what messages say, and comparisons with them. For message_check.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <type_traits>

#include "redbee/geometry/time.hpp"

namespace redbee::message_limits {

constexpr double kMaxLength_m = 1e5;              ///< heights, distances, steps
constexpr double kMaxSpeed_m_s = 1e4;             ///< m/s
constexpr double kMaxRotationRate = 300;          ///< rad/s; gyros end at 70
constexpr double kMaxRotationAcceleration = 1e6;  ///< rad/s^2
constexpr double kMaxAcceleration = 1e4;          ///< m/s^2; accelerometers end at 4000
constexpr double kMaxZoom = 100;                  ///< focal length over the configured one
constexpr double kMaxSigma = 1e6;                 ///< of any quantity, in its unit
constexpr double kMaxTestRatio = 1e24;            ///< of a test that a diverged filter fails
constexpr double kMaxEntry = 1e9;                 ///< of a homography in pixels
constexpr double kMaxCoordinate_px = 1e5;         ///< no image is larger
constexpr int32_t kMaxImageSide = 1 << 15;        ///< px
constexpr int32_t kMaxPoints = 1 << 20;           ///< tracks, inliers
constexpr int32_t kMaxDetections = 1 << 12;       ///< with kMaxTargets: kShortMessage holds them
constexpr int32_t kMaxTargets = 1 << 10;          ///< Geolocator keeps no more
constexpr std::size_t kMaxText = 1024;
constexpr double kUnitTolerance = 1e-6;   ///< of unit vectors and rotations
constexpr double kMinDeterminant = 1e-9;  ///< of a homography: below it the image collapses or is mirrored

/// False for a value that is not a number.
template <typename Low, typename Value, typename High>
bool isFrom(Low low, Value value, High high) {
  if constexpr (std::is_integral_v<Value>) {
    return static_cast<int64_t>(low) <= value && value <= static_cast<int64_t>(high);
  } else {
    return low <= value && value <= high;
  }
}

template <std::size_t kSize>
bool areFrom(double low, const double (&values)[kSize], double high) {
  return std::all_of(values, values + kSize, [&](double value) { return isFrom(low, value, high); });
}

inline bool isFlag(int8_t value) { return value == 0 || value == 1; }
inline bool isTime(int64_t utime) { return isPlausibleTime(CameraTime(fromUtime(utime))); }
inline bool isTextShort(const std::string& text) { return text.size() <= kMaxText; }

/// `message` has a size of an image, in px.
template <typename Message>
bool hasImageSize(const Message& message) {
  return isFrom(1, message.width, kMaxImageSide) && isFrom(1, message.height, kMaxImageSide);
}
/// `message` is about a frame and an earlier one, or the same at the start of a flight.
template <typename Message>
bool hasFrameTimes(const Message& message) {
  return isTime(message.utime) && isTime(message.utime_previous) && message.utime_previous <= message.utime;
}

struct Check {
  bool holds;
  const char* fault;
};
/// The first fault, of checks that may be evaluated all at once.
inline const char* firstFault(std::initializer_list<Check> checks) {
  const auto failed = std::find_if(checks.begin(), checks.end(), [](const Check& c) { return !c.holds; });
  return failed == checks.end() ? nullptr : failed->fault;
}

}  // namespace redbee::message_limits
