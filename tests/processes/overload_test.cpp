// Stages that are slower than the camera: what they skip, how late they are, and what the frames that are
// answered are worth.
#include <gtest/gtest.h>

#include <cstdio>
#include <map>
#include <set>
#include <vector>

#include "processes/node_factory.hpp"
#include "tests/support/fault_trial.hpp"

namespace redbee::test {
namespace {

/// Frames' periods that a stage takes for a frame of which it leaves out nothing.
using Slowness = std::map<const ProcessDescription*, double>;

/// The part that the segmentation takes at each rung of quality, by the instructions of its frame.
constexpr double kCosts[] = {1, 0.8};

/// What it says of itself: "overload: quality 1 of 1: ...".
size_t rungOf(Node& node) {
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
Answers runSlowly(const StackFlight& flight, const Slowness& slowness,
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

constexpr int kLearned = 24;             ///< frames
constexpr int kEnd = kFaultFrames - 14;  ///< what comes later may not be answered before the flight ends

struct Quality {
  int answered = 0;
  int trusted = 0;
  int longest_gap = 0;  ///< frames in a row without an answer
  double latest_s = 0;
  double found = 0;       ///< of the moving area, in trusted masks
  double false_area = 0;  ///< of the image, in trusted masks
};

Quality qualityOf(const Answers& answers, const StackFlight& flight) {
  Quality quality;
  int gap = 0;
  double moving = 0, found = 0, wrong = 0;
  for (int k = kLearned; k < kEnd; ++k) {
    const auto frame = static_cast<size_t>(k);
    const auto mask = answers.output.foreground.find(flight.frame_utimes[frame]);
    gap = mask == answers.output.foreground.end() ? gap + 1 : 0;
    quality.longest_gap = std::max(quality.longest_gap, gap);
    if (gap > 0) continue;
    ++quality.answered;
    quality.latest_s = std::max(quality.latest_s, answers.delay_s.at(mask->first));
    if (mask->second.status != foreground_t::GOOD) continue;
    ++quality.trusted;
    const cv::Mat truth = flight.masks[frame];
    const cv::Mat found_mask = maskOf(mask->second);
    moving += cv::countNonZero(truth);
    found += cv::countNonZero(found_mask & truth);
    wrong += cv::countNonZero(found_mask & (truth == 0)) / static_cast<double>(truth.total());
  }
  quality.found = moving > 0 ? found / moving : 0;
  quality.false_area = quality.trusted > 0 ? wrong / quality.trusted : 0;
  return quality;
}

Quality report(const char* name, const Answers& answers) {
  const Quality q = qualityOf(answers, undisturbedFlight());
  std::printf(
      "%-34s %2d of %2d frames answered, %2d trusted, gaps of %d, at most %.2f s late; found %.3f, false "
      "%.3f %%; quality down to %zu\n",
      name, q.answered, kEnd - kLearned, q.trusted, q.longest_gap, q.latest_s, q.found, 100 * q.false_area,
      answers.lowest);
  return q;
}

/// The same stack with time enough, given `of` frames less each `skip`-th.
Quality evenShare(const char* name, int skip) {
  std::set<int64_t> leaves_out;
  for (int k = kLearned; k < kFaultFrames; k += skip)
    leaves_out.insert(undisturbedFlight().frame_utimes[static_cast<size_t>(k)]);
  return report(name, runSlowly(undisturbedFlight(), {}, leaves_out));
}

/// `missed`: of the moving area, as much more than by the even share, at most.
void expectEvenShare(const char* name, const Slowness& slowness, double share, int skip,
                     double missed = 0.02) {
  const Quality even = evenShare("  every n-th frame not sent", skip);
  const Quality slow = report(name, runSlowly(undisturbedFlight(), slowness));
  const WaitParameters& waits = undisturbedFlight().configuration.waits;
  EXPECT_GE(slow.answered, share * (kEnd - kLearned) - 2);
  EXPECT_EQ(slow.trusted, slow.answered);
  EXPECT_LE(slow.longest_gap, 2);
  EXPECT_LE(slow.latest_s, waits.segmentation_s + 0.1);
  EXPECT_GE(slow.found, even.found - missed);
  EXPECT_LE(slow.false_area, even.false_area + 0.001);
}

TEST(Overload, ASegmentationThatIsTooSlowAtAnyQualityIsHardlyWorseThanAnEvenShareOfTheFrames) {
  constexpr double kMissed = 0.04;  // half of it without points
  expectEvenShare("segmentation takes 1.56 periods", {{&kMotionSegmentation, 1.25 / kCosts[1]}}, 0.8, 5,
                  kMissed);
  expectEvenShare("segmentation takes 1.88 periods", {{&kMotionSegmentation, 1.5 / kCosts[1]}}, 2.0 / 3, 3,
                  kMissed);
}

TEST(Overload, ASlowSegmentationLeavesOutElementsBeforeFrames) {
  const Quality whole = report("in time", runSlowly(undisturbedFlight(), {}));
  for (const double periods : {1.1, 1.2}) {
    const Answers answers = runSlowly(undisturbedFlight(), {{&kMotionSegmentation, periods}});
    const Quality slow = report(("segmentation takes " + std::to_string(periods)).c_str(), answers);
    EXPECT_GE(answers.lowest, 1U) << periods;
    EXPECT_EQ(slow.answered, kEnd - kLearned) << periods;
    EXPECT_EQ(slow.trusted, slow.answered) << periods;
    EXPECT_GE(slow.found, whole.found - 0.05) << periods;
    EXPECT_LE(slow.false_area, whole.false_area + 0.001) << periods;
  }
}

TEST(Overload, SlowVisionIsNoWorseThanAnEvenShareOfTheFrames) {
  expectEvenShare("vision takes 1.25 periods", {{&kVisualHomography, 1.25}}, 0.8, 5);
}

TEST(Overload, ASlowStackIsNoWorseThanAnEvenShareOfTheFrames) {
  expectEvenShare("vision 1.25, segmentation 1.2 periods",
                  {{&kVisualHomography, 1.25}, {&kMotionSegmentation, 1.2}}, 0.8, 5);
}

}  // namespace
}  // namespace redbee::test
