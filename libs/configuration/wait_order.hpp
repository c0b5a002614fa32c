// The order of the timeouts; internal to the configuration.
#pragma once

#include <string>
#include <vector>

namespace redbee::configuration {

/// Two timeouts (keys of the configuration), with the reason for their order.
struct WaitOrder {
  std::string longer;
  std::string shorter;
  std::string reason;
};

/// Derived from the process table: a process that waits for another one's message about the same frame needs
/// a longer timeout than that process has itself.
std::vector<WaitOrder> waitOrders();

}  // namespace redbee::configuration
