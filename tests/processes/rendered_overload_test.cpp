// Overload on the rendered flights: people that walk through a park, seen from above. As in overload_test,
// what a stack with too little time finds is compared with what it finds where frames are left out. Which
// frames those are moves it by .02 in either direction, with nothing slow at all: means are compared.
#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/imgcodecs.hpp>

#include "redbee/files/log.hpp"
#include "tests/support/imported_flight.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/shared_flight.hpp"
#include "tests/support/slow_stack.hpp"

namespace redbee::test {
namespace {

constexpr int kFrames = 144;
constexpr int kLearned = 36;
constexpr int kEnd = kFrames - 14;  ///< what comes later may not be answered before the flight ends

StackFlight imported(const fs::path& folder) {
  const ScratchFolder scratch;
  const fs::path file = scratch.path() / "flight.lcm";
  StackFlight flight;
  flight.configuration = importedAsl(folder, file);
  flight.configuration.overlay_period_frames = 0;
  LogReader log(file);
  while (const std::optional<LogEvent> event = log.next()) {
    if (event->channel == "CAMERA") {
      if (flight.frame_utimes.size() == kFrames) break;
      flight.frame_utimes.push_back(event->utime);
    }
    flight.messages.push_back({event->utime, event->channel, event->data});
  }
  return flight;
}

/// Their names are ns.
void addMasks(StackFlight& flight, const fs::path& folder) {
  std::map<int64_t, fs::path> masks;
  for (const auto& entry : fs::directory_iterator(folder))
    masks[std::stoll(entry.path().stem()) / 1000] = entry.path();
  for (const int64_t utime : flight.frame_utimes) {
    const auto at = std::min_element(masks.begin(), masks.end(), [&](const auto& a, const auto& b) {
      return std::abs(a.first - utime) < std::abs(b.first - utime);
    });
    flight.masks.push_back(cv::imread(at->second, cv::IMREAD_GRAYSCALE));
  }
}

class RenderedOverload : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    const auto folder = sharedFlight(std::string("rendered/") + GetParam());
    if (!folder) GTEST_SKIP() << "no rendered flight";
    flight_ = imported(*folder);
    addMasks(flight_, *folder / "labels" / "mask");
  }
  Quality report(const std::string& name, const Answers& answers) const {
    return printed(name.c_str(), qualityOf(answers, flight_, kLearned, kEnd), kFlown);
  }
  /// The frames that got no answer.
  std::set<int64_t> leftOut(const Answers& answers) const {
    std::set<int64_t> utimes;
    for (size_t k = kLearned; k < flight_.frame_utimes.size(); ++k) {
      if (answers.output.foreground.count(flight_.frame_utimes[k]) == 0)
        utimes.insert(flight_.frame_utimes[k]);
    }
    return utimes;
  }
  /// Of the share of the frames that are answered, which lies evenly among the others.
  void expectEvenShare(const Quality& slow, double share) const {
    EXPECT_GE(slow.answered, share * kFlown - 2);
    EXPECT_LE(slow.longest_gap, 2);
    EXPECT_LE(slow.latest_s, flight_.configuration.waits.segmentation_s + 0.1);
  }

  static constexpr int kFlown = kEnd - kLearned;
  StackFlight flight_;
};

/// Frames that have no answer find nothing. The even share is that for which the machine has time without
/// leaving out elements.
TEST_P(RenderedOverload, ASlowSegmentationFindsAsMuchAsAnEvenShareOfTheFrames) {
  report("with time enough", runSlowly(flight_, {}));
  const struct {
    double periods;
    int every;  ///< frame is not sent, or sent alone
  } kinds[] = {{1.25, 5}, {2, 2}};
  for (const auto& kind : kinds) {
    const double share = 1 / kind.periods;
    double even = 0, even_false = 0;
    for (int phase = 0; phase < kind.every; ++phase) {
      const Quality one = report("  every n-th frame not sent",
                                 runSlowly(flight_, {}, everyNth(flight_, kLearned + phase, kind.every)));
      even += one.found / kind.every;
      even_false += one.false_area / kind.every;
    }
    const Quality slow = report("segmentation takes " + std::to_string(kind.periods) + " periods",
                                runSlowly(flight_, {{&kMotionSegmentation, kind.periods}}));
    expectEvenShare(slow, share);
    EXPECT_GE(slow.found * slow.answered / kFlown, even * share - 0.01) << kind.periods;
    EXPECT_GE(slow.found, even - 0.03) << kind.periods;
    EXPECT_LE(slow.false_area, even_false + 0.001) << kind.periods;
  }
}

TEST_P(RenderedOverload, WhatSlowVisionLeavesIsWorthAsMuchAsIfTheOtherFramesHadNotBeenSent) {
  const double all_periods[] = {1.15, 1.2, 1.25, 1.3, 1.4};
  // A stage that is free takes up its work with the next message: periods between two of them.
  const double until_next = kFrames / static_cast<double>(flight_.messages.size());
  double more = 0, more_false = 0;
  for (const double periods : all_periods) {
    const Answers answers =
        runSlowly(flight_, {{&kVisualHomography, periods}, {&kMotionSegmentation, periods - 0.05}});
    const Quality slow =
        report("vision " + std::to_string(periods) + " periods, segmentation .05 less", answers);
    const Quality same = report("  the same frames not sent", runSlowly(flight_, {}, leftOut(answers)));
    expectEvenShare(slow, 1 / (periods + until_next));
    more += (slow.found - same.found) / static_cast<double>(std::size(all_periods));
    more_false += (slow.false_area - same.false_area) / static_cast<double>(std::size(all_periods));
  }
  std::printf("found %+.3f, false %+.3f %%\n", more, 100 * more_false);
  EXPECT_GE(more, -0.01);
  EXPECT_LE(more_false, 0.0005);
}

INSTANTIATE_TEST_SUITE_P(Flights, RenderedOverload, testing::Values("park1", "grove2"));

}  // namespace
}  // namespace redbee::test
