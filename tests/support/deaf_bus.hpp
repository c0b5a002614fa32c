// A bus on which one process does not hear every message that the others hear.
#pragma once

#include <functional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "redbee/bus/bus.hpp"

namespace redbee::test {

/// Decorates a bus: each message to a subscriber of this bus is lost with an independent probability.
/// Reproducible by the seed.
class DeafBus : public Bus {
 public:
  using Bus::publish;

  DeafBus(Bus& bus, double lost, unsigned seed) : bus_(bus), lost_(lost), random_(seed) {}

  void publish(const std::string& channel, const std::vector<uint8_t>& data) override {
    bus_.publish(channel, data);
  }
  Subscription subscribe(const std::string& channel, int capacity, Handler handler) override {
    return bus_.subscribe(channel, capacity,
                          [this, channel, handler = std::move(handler)](const uint8_t* data, int size) {
                            if (std::bernoulli_distribution(lost_)(random_)) {
                              if (onLost) onLost(channel, {data, data + size});
                            } else {
                              handler(data, size);
                            }
                          });
  }
  int handle(std::chrono::milliseconds timeout) override { return bus_.handle(timeout); }
  int64_t handlerFailures() const override { return bus_.handlerFailures(); }

  std::function<void(const std::string& channel, const std::vector<uint8_t>& data)> onLost;

 private:
  Bus& bus_;
  double lost_;
  std::mt19937 random_;
};

}  // namespace redbee::test
