// Whether what a message says can be true. The codec has compared its bytes with its layout only
// (libs/bus/codec.hpp); every reader of messages asks here before it uses one.
//
// The limits are far beyond what any sensor or flight delivers: what exceeds them is damaged or forged, and
// would cost arithmetic its meaning. What a plausible message may do is limited by the readers: gates,
// publishers, frame order.
#pragma once

#include <cstdint>
#include <vector>

#include "redbee/bus/codec.hpp"
#include "redbee/message_types.hpp"

namespace redbee {

/// What is wrong with a message, in a few words; nullptr where it is plausible. Members that a message
/// declares invalid (by `valid`, `status`, `has_...`) and those that nobody reads (of ins_t all but gyro and
/// accel; metadata) are not looked at.
const char* faultOf(const altimeter_t& message);
const char* faultOf(const clock_offset_t& message);
const char* faultOf(const detection_t& message);
const char* faultOf(const detections_t& message);
const char* faultOf(const earlier_step_t& message);
const char* faultOf(const filter_snapshot_t& message);
const char* faultOf(const foreground_t& message);
const char* faultOf(const fused_homography_t& message);
const char* faultOf(const gimbal_t& message);
const char* faultOf(const homography_t& message);
const char* faultOf(const image_metadata_t& message);
const char* faultOf(const image_t& message);
const char* faultOf(const inertial_homography_t& message);
const char* faultOf(const ins_t& message);
const char* faultOf(const lens_t& message);
const char* faultOf(const plane_motion_t& message);
const char* faultOf(const pose_t& message);
const char* faultOf(const process_health_t& message);
const char* faultOf(const row_motion_t& message);
const char* faultOf(const target_t& message);
const char* faultOf(const targets_t& message);
const char* faultOf(const tracks_t& message);
const char* faultOf(const visual_homography_t& message);

template <typename Message>
bool isPlausible(const Message& message) {
  return faultOf(message) == nullptr;
}

/// Returns false, and leaves `message` unspecified, unless the bytes are exactly one plausible message.
template <typename Message>
bool decodePlausible(const std::vector<uint8_t>& data, Message& message) {
  return decodeMessage(data.data(), static_cast<int>(data.size()), message) && isPlausible(message);
}

}  // namespace redbee
