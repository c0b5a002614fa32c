// A bus on which one message is missing for a while.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "redbee/bus/bus.hpp"

namespace redbee::test {

/// Decorates a bus: messages of this type on this channel with a time in [from, to) are not published.
template <typename Message>
class SilentBus : public Bus {
 public:
  using Bus::publish;

  SilentBus(Bus& bus, std::string channel, int64_t from, int64_t to)
      : bus_(bus), channel_(std::move(channel)), from_(from), to_(to) {}

  void publish(const std::string& channel, const std::vector<uint8_t>& data) override {
    Message message;
    const bool is_missing = channel == channel_ &&
                            decodeMessage(data.data(), static_cast<int>(data.size()), message) &&
                            message.utime >= from_ && message.utime < to_;
    if (!is_missing) bus_.publish(channel, data);
  }
  Subscription subscribe(const std::string& channel, int capacity, Handler handler) override {
    return bus_.subscribe(channel, capacity, std::move(handler));
  }
  int handle(std::chrono::milliseconds timeout) override { return bus_.handle(timeout); }
  int64_t handlerFailures() const override { return bus_.handlerFailures(); }

 private:
  Bus& bus_;
  std::string channel_;
  int64_t from_, to_;
};

}  // namespace redbee::test
