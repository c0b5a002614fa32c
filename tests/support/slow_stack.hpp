// Flies a stack whose stages are slow, in message time: reproducible on every machine.
#pragma once

#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>
#include <opencv2/imgcodecs.hpp>
#include <set>
#include <string>
#include <vector>

#include "processes/node_factory.hpp"
#include "tests/support/stack_run.hpp"

namespace redbee::test {

/// Frames' periods that a stage takes for a frame of which it leaves out nothing.
using Slowness = std::map<const ProcessDescription*, double>;

/// The part that the segmentation takes at each rung of quality, by the instructions of its frame.
constexpr double kCosts[] = {1, 0.9};

/// What it says of itself: "overload: quality 1 of 1: ...".
inline size_t rungOf(Node& node) {
  const std::string message = node.health().nextMessage().message, name = "overload: quality ";
  return message.rfind(name, 0) == 0 ? static_cast<size_t>(message.at(name.size()) - '0') : 0;
}

struct Answers {
  StackOutput output;
  std::map<int64_t, double> delay_s;  ///< message time between a frame and its mask
  size_t lowest = 0;                  ///< rung of quality
};

/// Runs the stack, a stage of `slowness` being busy in message time after each frame. `leaves_out`: frames
/// whose image is not sent.
inline Answers runSlowly(const StackFlight& flight, const Slowness& slowness,
                         const std::set<int64_t>& leaves_out = {}) {
  const auto bus = makeLcmBus("memq://");
  Answers answers;
  int64_t now = flight.messages.front().utime;
  const std::vector<Subscription> subscriptions = answers.output.subscribe(*bus);
  const Subscription masks = bus->subscribe<foreground_t>("FOREGROUND", 64, [&](const foreground_t& m) {
    answers.delay_s[m.utime] = 1e-6 * static_cast<double>(now - m.utime);
  });
  const double period_us = static_cast<double>(flight.frame_utimes[1] - flight.frame_utimes[0]);
  struct Worker {
    std::unique_ptr<Node> node;
    const ProcessDescription* stage;
    double period_us;
    double free_at;
  };
  std::vector<Worker> workers;
  for (const ProcessDescription* stage : kStages) {
    const auto slow = slowness.find(stage);
    workers.push_back({makeNode(*stage, *bus, flight.configuration), stage,
                       slow == slowness.end() ? 0 : slow->second * period_us, static_cast<double>(now)});
  }
  const auto work = [&](Worker& worker) {
    int64_t done = worker.node->health().published();
    while (worker.free_at <= static_cast<double>(now) && worker.node->processNext()) {
      const int64_t frames = worker.node->health().published();
      const size_t rung = worker.stage == &kMotionSegmentation ? rungOf(*worker.node) : 0;
      if (frames > done) worker.free_at = static_cast<double>(now) + worker.period_us * kCosts[rung];
      answers.lowest = std::max(answers.lowest, rung);
      done = frames;
    }
  };
  for (const SensorMessage& sent : flight.messages) {
    now = sent.utime;
    if (leaves_out.count(sent.utime) > 0 && sent.channel == "CAMERA") continue;
    bus->publish(sent.channel, sent.data);
    do {
      for (Worker& worker : workers) work(worker);
    } while (bus->handle(std::chrono::milliseconds(0)) > 0);
  }
  return answers;
}

struct Quality {
  int answered = 0;
  int trusted = 0;
  int longest_gap = 0;  ///< frames in a row without an answer
  double latest_s = 0;
  double found = 0;       ///< of the moving area, in trusted masks
  double false_area = 0;  ///< of the image, in trusted masks
  size_t lowest = 0;      ///< rung of quality
};

/// Of the frames [from, to).
inline Quality qualityOf(const Answers& answers, const StackFlight& flight, int from, int to) {
  Quality quality;
  quality.lowest = answers.lowest;
  int gap = 0;
  double moving = 0, found = 0, wrong = 0;
  for (int k = from; k < to; ++k) {
    const auto frame = static_cast<size_t>(k);
    const auto mask = answers.output.foreground.find(flight.frame_utimes[frame]);
    gap = mask == answers.output.foreground.end() ? gap + 1 : 0;
    quality.longest_gap = std::max(quality.longest_gap, gap);
    if (gap > 0) continue;
    ++quality.answered;
    quality.latest_s = std::max(quality.latest_s, answers.delay_s.at(mask->first));
    if (mask->second.status != foreground_t::GOOD) continue;
    ++quality.trusted;
    const cv::Mat truth = flight.masks[frame];  // what is neither 0 nor 255 is left out
    const cv::Mat found_mask = cv::imdecode(mask->second.mask, cv::IMREAD_GRAYSCALE);
    moving += cv::countNonZero(truth == 255);
    found += cv::countNonZero(found_mask & (truth == 255));
    wrong += cv::countNonZero(found_mask & (truth == 0)) / static_cast<double>(truth.total());
  }
  quality.found = moving > 0 ? found / moving : 0;
  quality.false_area = quality.trusted > 0 ? wrong / quality.trusted : 0;
  return quality;
}

inline Quality printed(const char* name, const Quality& q, int frames) {
  std::printf(
      "%-34s %2d of %2d frames answered, %2d trusted, gaps of %d, at most %.2f s late; found %.3f, false "
      "%.3f %%; quality down to %zu\n",
      name, q.answered, frames, q.trusted, q.longest_gap, q.latest_s, q.found, 100 * q.false_area, q.lowest);
  return q;
}

/// Each `skip`-th frame from `first` on.
inline std::set<int64_t> everyNth(const StackFlight& flight, int first, int skip) {
  std::set<int64_t> utimes;
  for (size_t k = static_cast<size_t>(first); k < flight.frame_utimes.size(); k += static_cast<size_t>(skip))
    utimes.insert(flight.frame_utimes[k]);
  return utimes;
}

}  // namespace redbee::test
