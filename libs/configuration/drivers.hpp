// Which of the process table's drivers, and of what else is optional, a vehicle has.
#pragma once

#include <vector>

#include "redbee/configuration/configuration.hpp"
#include "redbee/configuration/process_table.hpp"

namespace redbee {

/// The camera's where capture.pipeline is set, the autopilot's where autopilot.link is set; the ground
/// station's server where serve.listen is set, the geolocation where geolocation.enabled is, the ground link
/// where ground_link.link is set.
inline std::vector<const ProcessDescription*> configuredDrivers(const Configuration& configuration) {
  std::vector<const ProcessDescription*> drivers;
  if (!configuration.capture.pipeline.empty()) drivers.push_back(&kCamera);
  if (!configuration.autopilot.link.empty()) drivers.push_back(&kAutopilot);
  if (!configuration.serve.listen.empty()) drivers.push_back(&kServe);
  if (configuration.geolocation.enabled) drivers.push_back(&kGeolocation);
  if (!configuration.ground_link.link.empty()) drivers.push_back(&kGroundLink);
  return drivers;
}

}  // namespace redbee
