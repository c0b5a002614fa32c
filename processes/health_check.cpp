#include "processes/health_check.hpp"

#include <algorithm>

#include "redbee/configuration/process_table.hpp"

namespace redbee {

bool isKnownProcess(const std::string& name) {
  const auto has_name = [&](const ProcessDescription* process) { return programName(*process) == name; };
  return std::any_of(kStages.begin(), kStages.end(), has_name) ||
         std::any_of(kDrivers.begin(), kDrivers.end(), has_name) ||
         std::any_of(kSupportProcesses.begin(), kSupportProcesses.end(), has_name);
}

}  // namespace redbee
