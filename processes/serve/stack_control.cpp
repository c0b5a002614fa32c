#include <algorithm>
#include <memory>

#include "processes/redbee/vehicle/supervisor_client.hpp"
#include "processes/serve/station.hpp"
#include "redbee/configuration/process_table.hpp"
#include "redbee/files/user_error.hpp"

namespace redbee {

StackControl supervisedStack() {
  try {
    auto client = std::make_shared<SupervisorClient>(SupervisorClient::ofParent());
    StackControl control;
    control.is_recording = [client]() -> std::optional<bool> {
      const auto processes = client->processes();
      if (!processes) return std::nullopt;
      return std::any_of(processes->begin(), processes->end(), [](const SupervisedProcess& process) {
        return process.name == kRecord.name && process.is_up;
      });
    };
    control.act = [client](const std::string& action, const std::string& process) {
      return client->act(action, process);
    };
    return control;
  } catch (const UserError&) {
    return {[] { return std::optional<bool>(); },
            [](const std::string&, const std::string&) {
              return std::string(
                  "this page is not served by a stack of fly up: there is nothing to start or stop");
            }};
  }
}

}  // namespace redbee
