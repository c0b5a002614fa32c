// Which waits must be longer than which; internal to the configuration.
#pragma once

#include <string>
#include <vector>

namespace redbee::configuration {

/// Two keys of the configuration, with the reason for their order.
struct WaitOrder {
  std::string longer;
  std::string shorter;
  std::string reason;
};

/// From the process table: a process that waits for another one's message about the same frame must have the
/// longer patience, if that one waits for a third.
std::vector<WaitOrder> waitOrders();

}  // namespace redbee::configuration
