// A bus that loses, duplicates and reorders messages while `disturbed` is set.
#pragma once

#include <chrono>
#include <cmath>
#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "redbee/bus/bus.hpp"

namespace redbee::test {

/// Independent probabilities, as with netem.
struct PacketFaults {
  double lost = 0;
  double duplicated = 0;
  double reordered = 0;
};

/// Decorates a bus. A message is lost when any of its datagrams is: LCM cuts a message into pieces of
/// kDatagramBytes (lcm/udpm_util.h of 1.3.1, LCM_FRAGMENT_MAX_PAYLOAD) and delivers whole ones only, so that
/// images are lost more often. A reordered message is overtaken by up to kMaxOvertaking later ones, about two
/// frames. Reproducible by the seed.
class LossyBus : public Bus {
 public:
  using Bus::publish;
  static constexpr size_t kDatagramBytes = 65487;
  static constexpr int kMaxOvertaking = 40;

  LossyBus(Bus& bus, PacketFaults faults, unsigned seed) : bus_(bus), faults_(faults), random_(seed) {}

  void publish(const std::string& channel, const std::vector<uint8_t>& data) override {
    if (!disturbed) {
      releaseAll();
      bus_.publish(channel, data);
      return;
    }
    ++sent_;
    const double datagrams = std::ceil(static_cast<double>(data.size() + 1) / kDatagramBytes);
    if (happens(1 - std::pow(1 - faults_.lost, datagrams))) {
      ++lost_;
    } else if (happens(faults_.reordered)) {
      held_.push_back({channel, data, std::uniform_int_distribution<int>(1, kMaxOvertaking)(random_)});
    } else {
      bus_.publish(channel, data);
      if (happens(faults_.duplicated)) bus_.publish(channel, data);
    }
    releaseDue();
  }
  Subscription subscribe(const std::string& channel, int capacity, Handler handler) override {
    return bus_.subscribe(channel, capacity, std::move(handler));
  }
  int handle(std::chrono::milliseconds timeout) override { return bus_.handle(timeout); }
  int64_t handlerFailures() const override { return bus_.handlerFailures(); }

  bool disturbed = false;
  int sent() const { return sent_; }  ///< while disturbed
  int lost() const { return lost_; }

 private:
  struct Held {
    std::string channel;
    std::vector<uint8_t> data;
    int overtakers_left;
  };

  bool happens(double probability) {
    return std::uniform_real_distribution<double>(0, 1)(random_) < probability;
  }

  void releaseDue() {
    for (Held& held : held_) --held.overtakers_left;
    std::vector<Held> waiting;
    for (Held& held : std::exchange(held_, {})) {
      if (held.overtakers_left > 0) {
        waiting.push_back(std::move(held));
      } else {
        bus_.publish(held.channel, held.data);
      }
    }
    held_ = std::move(waiting);
  }
  void releaseAll() {
    for (const Held& held : std::exchange(held_, {})) bus_.publish(held.channel, held.data);
  }

  Bus& bus_;
  PacketFaults faults_;
  std::mt19937 random_;
  std::vector<Held> held_;
  int sent_ = 0;
  int lost_ = 0;
};

}  // namespace redbee::test
