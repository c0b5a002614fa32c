// Access to the image messages of a flight.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "redbee/image_t.hpp"

namespace redbee {

/// Calls `take` for each image message on `channel`, in the log's order; messages that do not decode are
/// skipped. Throws InputError if the log cannot be read.
void forEachImage(const std::filesystem::path& log, const std::string& channel,
                  const std::function<void(const image_t& message)>& take);

/// Times of the flight's frames [us], sorted. Throws InputError if there are none.
std::vector<int64_t> imageTimes(const std::filesystem::path& log, const std::string& channel);

}  // namespace redbee
