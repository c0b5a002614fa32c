// Whether a PROCESS_HEALTH that decodes can be true: anybody on the network may have sent it.
#pragma once

#include <string>

#include "redbee/process_health_t.hpp"

namespace redbee {

/// The state is one of the five, the process number is one, counts and figures are finite, not negative and
/// below what years of flight reach, texts are short.
bool isPlausible(const process_health_t& health);

/// Whether it is a name of the process table, as PROCESS_HEALTH has it.
bool isKnownProcess(const std::string& name);

}  // namespace redbee
