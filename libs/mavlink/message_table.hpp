// Every message of the dialect "ardupilotmega", which holds common and what both autopilots send: without its
// CRC_EXTRA a frame cannot be told from noise, and its sequence number not be counted.
#pragma once

#include <cstdint>
#include <optional>

#include "redbee/mavlink/message_fields.hpp"

namespace redbee::mavlink {

/// std::nullopt for a message of another dialect.
std::optional<MessageLayout> layoutOf(uint32_t id);

}  // namespace redbee::mavlink
