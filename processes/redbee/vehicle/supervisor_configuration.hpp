// Generates supervisor's configuration from the process table.
#pragma once

#include <string>
#include <vector>

#include "redbee/configuration/process_table.hpp"

namespace redbee {

/// A supervisord.conf with all processes of the table, of the drivers these (configuredDrivers()), restarted
/// when they exit. scripts/fly sets the environment variables that it refers to.
std::string supervisorConfiguration(const std::vector<const ProcessDescription*>& drivers = {});

}  // namespace redbee
