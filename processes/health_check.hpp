// Whether a PROCESS_HEALTH may be believed: anybody on the network may have sent it.
#pragma once

#include <string>

#include "redbee/node/message_check.hpp"  // isPlausible()

namespace redbee {

/// Whether it is a name of the process table, as PROCESS_HEALTH has it.
bool isKnownProcess(const std::string& name);

}  // namespace redbee
