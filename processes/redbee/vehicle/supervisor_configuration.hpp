// The process table as supervisor reads it.
#pragma once

#include <string>

namespace redbee {

/// A supervisord.conf: every process of the table, restarted whenever it ends. scripts/fly sets the
/// environment variables that it refers to.
std::string supervisorConfiguration();

}  // namespace redbee
