// Collects the output of the stack and compares it with the truth.
#pragma once

#include <algorithm>
#include <chrono>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "redbee/bus/bus.hpp"
#include "redbee/detections_t.hpp"
#include "redbee/foreground_t.hpp"
#include "redbee/process_health_t.hpp"
#include "tests/support/endless_flight.hpp"

namespace redbee::test {

/// Identities of the detections on each car; there may be several.
using Identities = std::map<int, std::set<int>>;

/// The stack's output for one frame.
struct FrameResult {
  std::chrono::steady_clock::time_point received;
  int8_t status = -1;
  double false_fraction = 0;  ///< of the image: in the mask, but background in truth
  double found_fraction = 0;  ///< of the movers' pixels
  Identities ids_of_car;
};

class Observer {
 public:
  using Clock = std::chrono::steady_clock;

  Observer(Bus& bus, const EndlessFlight& flight) : flight_(flight) {
    subscriptions_.push_back(
        bus.subscribe<foreground_t>("FOREGROUND", 64, [this](const foreground_t& m) { onMessage(m); }));
    subscriptions_.push_back(
        bus.subscribe<detections_t>("DETECTIONS", 64, [this](const detections_t& m) { onMessage(m); }));
    subscriptions_.push_back(bus.subscribe<process_health_t>(
        "PROCESS_HEALTH", 256, [this](const process_health_t& m) { onMessage(m); }));
  }

  const std::map<int64_t, FrameResult>& frames() const { return frames_; }
  /// Every process id that a program has had, oldest first.
  const std::vector<int>& pids(const std::string& process) const {
    static const std::vector<int> none;
    const auto it = pids_.find(process);
    return it == pids_.end() ? none : it->second;
  }
  const std::map<std::string, process_health_t>& health() const { return health_; }
  int deathsReported() const { return deaths_; }

  /// The first frame after `utime` with a GOOD mask.
  std::optional<std::pair<int64_t, FrameResult>> firstGoodAfter(int64_t utime) const {
    for (auto it = frames_.upper_bound(utime); it != frames_.end(); ++it) {
      if (it->second.status == 0) return *it;
    }
    return std::nullopt;
  }
  bool allGood(int64_t from_utime, int frames) const {
    int good = 0;
    for (auto it = frames_.lower_bound(from_utime); it != frames_.end(); ++it) {
      good = it->second.status == 0 ? good + 1 : 0;
    }
    return good >= frames;
  }

 private:
  void onMessage(const foreground_t& m) {
    FrameResult& result = frames_[m.utime];
    result.received = Clock::now();
    result.status = m.status;
    const cv::Mat mask = cv::imdecode(m.mask, cv::IMREAD_GRAYSCALE);
    const cv::Mat truth = flight_.truth(flight_.frameAt(m.utime)).moving;
    if (mask.size() != truth.size()) return;
    result.false_fraction = cv::countNonZero(mask & (truth == 0)) / static_cast<double>(mask.total());
    result.found_fraction =
        cv::countNonZero(mask & truth) / std::max(1.0, static_cast<double>(cv::countNonZero(truth)));
  }

  void onMessage(const detections_t& m) {
    for (const auto& [car, box] : flight_.truth(flight_.frameAt(m.utime)).cars) {
      for (const detection_t& d : m.detections) {
        const cv::Rect detected(d.x, d.y, d.width, d.height);
        if (d.seen != 0 && (detected & box).area() > 0.5 * detected.area())
          frames_[m.utime].ids_of_car[car].insert(d.id);
      }
    }
  }

  void onMessage(const process_health_t& m) {
    constexpr int8_t kDead = 4;
    deaths_ += m.state == kDead ? 1 : 0;
    health_[m.process] = m;
    auto& pids = pids_[m.process];
    if (m.state != kDead && (pids.empty() || pids.back() != m.pid)) pids.push_back(m.pid);
  }

  const EndlessFlight& flight_;
  std::map<int64_t, FrameResult> frames_;
  std::map<std::string, std::vector<int>> pids_;
  std::map<std::string, process_health_t> health_;
  int deaths_ = 0;
  std::vector<Subscription> subscriptions_;
};

}  // namespace redbee::test
