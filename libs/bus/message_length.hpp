// How long messages are: what has neither images nor points is short, and who receives only such need not
// take the fragments of the others from the network.
#pragma once

#include <cstdint>

namespace redbee {

/// Bytes. message_limits.hpp keeps the short types' below it.
constexpr uint32_t kShortMessage = 256 << 10;

class altimeter_t;
class clock_offset_t;
class detections_t;
class gimbal_t;
class ins_t;
class lens_t;
class pose_t;
class process_health_t;
class targets_t;

template <typename Message>
inline constexpr bool kIsShort = false;
template <>
inline constexpr bool kIsShort<altimeter_t> = true;
template <>
inline constexpr bool kIsShort<clock_offset_t> = true;
template <>
inline constexpr bool kIsShort<detections_t> = true;
template <>
inline constexpr bool kIsShort<gimbal_t> = true;
template <>
inline constexpr bool kIsShort<ins_t> = true;
template <>
inline constexpr bool kIsShort<lens_t> = true;
template <>
inline constexpr bool kIsShort<pose_t> = true;
template <>
inline constexpr bool kIsShort<process_health_t> = true;
template <>
inline constexpr bool kIsShort<targets_t> = true;

}  // namespace redbee
