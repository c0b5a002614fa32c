// A lossy network between processes that each have an LCM group of their own: what one publishes reaches the
// others through this relay, which loses, repeats and delays each copy independently.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <random>
#include <set>
#include <string>
#include <thread>
#include <unordered_map>
#include <utility>
#include <vector>

#include "redbee/bus/bus.hpp"
#include "tests/support/relay_bus.hpp"

namespace redbee::test {

class LiveRelay {
 public:
  /// The first URL is the observer's, to whom everything arrives; delays are divided by `speed`.
  LiveRelay(const std::vector<std::string>& urls, const RelayFaults& faults, double speed)
      : faults_(faults), speed_(speed), sent_(urls.size()) {
    for (size_t i = 0; i < urls.size(); ++i) {
      buses_.push_back(makeLcmBus(urls[i]));
      for (const std::string& channel : kChannels) {
        subscriptions_.push_back(
            buses_[i]->subscribe(channel, 256, [this, i, channel](const uint8_t* data, int size) {
              pass(i, {channel, std::vector<uint8_t>(data, data + size)});
            }));
      }
    }
    thread_ = std::thread([this] {
      while (!over_) step();
    });
  }
  ~LiveRelay() {
    over_ = true;
    thread_.join();
  }
  LiveRelay(const LiveRelay&) = delete;
  LiveRelay& operator=(const LiveRelay&) = delete;

  void setFaults(const RelayFaults& faults) {
    const std::lock_guard lock(mutex_);
    faults_ = faults;
  }
  /// Times [us] of the images that did not reach the process of the last URL.
  std::set<int64_t> imagesLost() const {
    const std::lock_guard lock(mutex_);
    return images_lost_;
  }

 private:
  using Clock = std::chrono::steady_clock;
  using Message = std::pair<std::string, std::vector<uint8_t>>;
  struct Held {
    size_t to;
    Message message;
  };
  inline static const std::vector<std::string> kChannels = {
      "CAMERA",           "IMU",        "ALTIMETER",  "INERTIAL_HOMOGRAPHY", "VISUAL_HOMOGRAPHY",
      "FUSED_HOMOGRAPHY", "FOREGROUND", "DETECTIONS", "PROCESS_HEALTH"};

  void step() {
    for (const auto& bus : buses_) bus->handle(std::chrono::milliseconds(0));
    while (!held_.empty() && held_.begin()->first <= Clock::now()) {
      const Held due = std::move(held_.begin()->second);
      held_.erase(held_.begin());
      deliver(due.to, due.message);
    }
    std::this_thread::sleep_for(std::chrono::microseconds(500));
  }

  static size_t hashOf(const Message& message) {
    return std::hash<std::string>()(message.first +
                                    std::string(message.second.begin(), message.second.end()));
  }

  void deliver(size_t to, const Message& message) {
    ++sent_[to][hashOf(message)];
    buses_[to]->publish(message.first, message.second);
  }

  /// A group also hands the relay's own messages back to it.
  bool isOwn(size_t from, const Message& message) {
    const auto own = sent_[from].find(hashOf(message));
    if (own == sent_[from].end()) return false;
    if (--own->second == 0) sent_[from].erase(own);
    return true;
  }

  void pass(size_t from, const Message& message) {
    if (isOwn(from, message)) return;
    const RelayFaults faults = currentFaults();
    for (size_t to = 0; to < buses_.size(); ++to) {
      if (to == 0 && from != 0) deliver(to, message);
      if (to == 0 || to == from) continue;
      if (happens(faults.lost)) {
        if (to + 1 == buses_.size()) noteLost(message);
        continue;
      }
      if (happens(faults.duplicated)) held_.emplace(later(faults), Held{to, message});
      if (happens(faults.delayed)) {
        held_.emplace(later(faults), Held{to, message});
      } else {
        deliver(to, message);
      }
    }
  }

  void noteLost(const Message& message) {
    image_t image;
    if (message.first != "CAMERA" ||
        !decodeMessage(message.second.data(), static_cast<int>(message.second.size()), image))
      return;
    const std::lock_guard lock(mutex_);
    images_lost_.insert(image.utime);
  }

  bool happens(double probability) { return std::bernoulli_distribution(probability)(random_); }
  RelayFaults currentFaults() const {
    const std::lock_guard lock(mutex_);
    return faults_;
  }
  Clock::time_point later(const RelayFaults& faults) {
    const double ms = faults.drawDelay(random_) / speed_;
    return Clock::now() + std::chrono::microseconds(static_cast<int64_t>(1e3 * ms));
  }

  RelayFaults faults_;
  double speed_;
  std::mt19937 random_{1};
  std::vector<std::unique_ptr<Bus>> buses_;
  std::vector<Subscription> subscriptions_;
  std::vector<std::unordered_map<size_t, int>> sent_;  ///< by URL, messages of the relay not yet heard again
  std::multimap<Clock::time_point, Held> held_;
  mutable std::mutex mutex_;
  std::set<int64_t> images_lost_;
  std::atomic<bool> over_ = false;
  std::thread thread_;
};

}  // namespace redbee::test
