// The keys of `detection`; internal to the configuration.
#pragma once

#include <vector>

#include "redbee/configuration/configuration_table.hpp"

namespace redbee::configuration {

std::vector<Setting> detectionSettings();

}  // namespace redbee::configuration
