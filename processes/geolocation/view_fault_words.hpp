// What is missing for a view of the ground, in words.
#pragma once

#include <cstdint>
#include <string>

#include "redbee/configuration/configuration.hpp"
#include "redbee/geolocation/view_estimator.hpp"

namespace redbee {

/// Empty for kNone.
std::string wordsOf(ViewFault fault, const Channels& channels);

}  // namespace redbee
