// Which drivers of the process table a vehicle has.
#pragma once

#include <vector>

#include "redbee/configuration/configuration.hpp"
#include "redbee/configuration/process_table.hpp"

namespace redbee {

/// The camera's where capture.pipeline is set, the autopilot's where autopilot.link is set, the ground
/// station's server where serve.listen is set.
inline std::vector<const ProcessDescription*> configuredDrivers(const Configuration& configuration) {
  std::vector<const ProcessDescription*> drivers;
  if (!configuration.capture.pipeline.empty()) drivers.push_back(&kCamera);
  if (!configuration.autopilot.link.empty()) drivers.push_back(&kAutopilot);
  if (!configuration.serve.listen.empty()) drivers.push_back(&kServe);
  return drivers;
}

}  // namespace redbee
