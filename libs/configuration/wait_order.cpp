#include "redbee/configuration/wait_order.hpp"

#include <algorithm>

#include "redbee/configuration/process_table.hpp"

namespace redbee::configuration {
namespace {

bool contains(const KeyList& keys, std::string_view key) {
  return std::find(keys.begin(), keys.end(), key) != keys.end();
}

std::string waitKey(const ProcessDescription& process) { return "waits." + std::string(process.timeout); }

void appendOrdersOf(const ProcessDescription& waiter, std::string_view channel,
                    std::vector<WaitOrder>& orders) {
  for (const ProcessDescription* other : kStages) {
    if (!contains(other->publishes, channel) || other->waits_for.empty()) continue;
    orders.push_back(
        {waitKey(waiter), waitKey(*other),
         std::string(waiter.name) + " waits for " + std::string(other->name) + ", which waits itself"});
  }
}

}  // namespace

std::vector<WaitOrder> waitOrders() {
  std::vector<WaitOrder> orders;
  for (const ProcessDescription* waiter : kStages) {
    for (const std::string_view channel : waiter->waits_for) appendOrdersOf(*waiter, channel, orders);
  }
  return orders;
}

}  // namespace redbee::configuration
