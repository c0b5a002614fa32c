// A lossy relay between the stack and itself: every message that is published passes through it.
#pragma once

#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "redbee/bus/bus.hpp"

namespace redbee::test {

/// Independent probabilities of each message, on every channel.
struct RelayFaults {
  double lost = 0;
  double duplicated = 0;  ///< delivered a second time after a delay, too
  double delayed = 0;     ///< by `delay_min_ms` to `delay_max_ms`, uniformly distributed
  double delay_min_ms = 25;
  double delay_max_ms = 75;

  double drawDelay(std::mt19937& random) const {  ///< ms
    return std::uniform_real_distribution<double>(delay_min_ms, delay_max_ms)(random);
  }
};

/// Decorates a bus. The stack's output passes undisturbed. Delays are in message time, which the test
/// advances. Reproducible by the seed.
class RelayBus : public Bus {
 public:
  using Bus::publish;

  RelayBus(Bus& bus, const RelayFaults& faults, unsigned seed) : bus_(bus), faults_(faults), random_(seed) {}

  /// Delivers what is due at this message time [us].
  void advance(int64_t utime) {
    now_ = utime;
    while (!held_.empty() && held_.begin()->first <= utime) {
      const auto [channel, data] = std::move(held_.begin()->second);
      held_.erase(held_.begin());
      bus_.publish(channel, data);
    }
  }

  void publish(const std::string& channel, const std::vector<uint8_t>& data) override {
    if (isOutput(channel)) return bus_.publish(channel, data);
    ++sent_;
    if (happens(faults_.lost)) {
      ++lost_;
      if (onLost) onLost(channel, data);
      return;
    }
    if (happens(faults_.duplicated)) held_.emplace(now_ + delay(), Message{channel, data});
    if (happens(faults_.delayed)) {
      held_.emplace(now_ + delay(), Message{channel, data});
    } else {
      bus_.publish(channel, data);
    }
  }
  Subscription subscribe(const std::string& channel, int capacity, Handler handler) override {
    return bus_.subscribe(channel, capacity, std::move(handler));
  }
  int handle(std::chrono::milliseconds timeout) override { return bus_.handle(timeout); }
  int64_t handlerFailures() const override { return bus_.handlerFailures(); }

  std::function<void(const std::string& channel, const std::vector<uint8_t>& data)> onLost;
  int sent() const { return sent_; }
  int lost() const { return lost_; }

 private:
  using Message = std::pair<std::string, std::vector<uint8_t>>;

  static bool isOutput(const std::string& channel) {
    return channel == "FOREGROUND" || channel == "DETECTIONS" || channel == "OVERLAY";
  }
  bool happens(double probability) {
    return probability > 0 && std::uniform_real_distribution<double>(0, 1)(random_) < probability;
  }
  int64_t delay() { return static_cast<int64_t>(1e3 * faults_.drawDelay(random_)); }

  Bus& bus_;
  RelayFaults faults_;
  std::mt19937 random_;
  std::multimap<int64_t, Message> held_;
  int64_t now_ = 0;
  int sent_ = 0;
  int lost_ = 0;
};

}  // namespace redbee::test
