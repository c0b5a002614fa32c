// The key that frames are signed with.
#pragma once

#include <filesystem>
#include <optional>

#include "redbee/mavlink/signing.hpp"

namespace redbee {

/// std::nullopt for an empty path. Throws UserError unless it is a file of 64 hexadecimal digits that only
/// its owner and group may read.
std::optional<mavlink::SigningKey> readSigningKey(const std::filesystem::path& file);

/// By the computer's time of day.
mavlink::SigningTime signingTimeOfDay();

}  // namespace redbee
