// Generates supervisor's configuration from the process table.
#pragma once

#include <string>

namespace redbee {

/// A supervisord.conf with all processes of the table, restarted when they exit. scripts/fly sets the
/// environment variables that it refers to.
std::string supervisorConfiguration();

}  // namespace redbee
