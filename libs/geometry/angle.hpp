// Conversion from degrees, which only user interfaces use; all computations are in radians.
#pragma once

namespace redbee {

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kTurn = 2 * kPi;      ///< rad
inline constexpr double kDegree = kPi / 180;  ///< rad

}  // namespace redbee
