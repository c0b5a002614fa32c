// Names of message types, by what the bytes begin with.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace redbee {

/// "image_t" for a message of that type; empty for a hash that is none of ours.
std::string messageName(const std::vector<uint8_t>& data);

/// The hash that the bytes begin with, as 0x and 16 digits; empty for fewer than eight bytes.
std::string messageHash(const std::vector<uint8_t>& data);

}  // namespace redbee
