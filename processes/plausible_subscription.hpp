// Subscriptions of programs that listen to the stages without being one.
#pragma once

#include <functional>
#include <string>
#include <utility>

#include "redbee/bus/bus.hpp"
#include "redbee/node/message_check.hpp"

namespace redbee {

/// `damaged` is called for what does not decode or is not plausible.
template <typename Message>
Subscription subscribePlausible(Bus& bus, const std::string& channel, int queue,
                                std::function<void(const Message&)> handler,
                                const std::function<void()>& damaged) {
  return bus.subscribe<Message>(
      channel, queue,
      [handler = std::move(handler), damaged](const Message& message) {
        isPlausible(message) ? handler(message) : damaged();
      },
      damaged);
}

}  // namespace redbee
