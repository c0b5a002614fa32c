// Overload on the rendered flights: people that walk through a park, seen from above. As in overload_test,
// what a stack with too little time finds is compared with what it finds where frames are left out evenly.
#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/imgcodecs.hpp>

#include "processes/redbee/vehicle/import_flight.hpp"
#include "redbee/files/log.hpp"
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
  ImportOptions options;
  options.source = folder;
  options.log = scratch.path() / "flight.lcm";
  const auto asl = std::find_if(importers().begin(), importers().end(),
                                [](const Importer& importer) { return importer.name == "asl"; });
  StackFlight flight;
  flight.configuration = loadConfiguration(importFlight(*asl, options).configuration);
  flight.configuration.overlay_period_frames = 0;
  LogReader log(options.log);
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

class RenderedOverload : public testing::TestWithParam<const char*> {};

TEST_P(RenderedOverload, IsNoWorseThanAnEvenShareOfTheFrames) {
  const auto folder = sharedFlight(std::string("rendered/") + GetParam());
  if (!folder) GTEST_SKIP() << "no rendered flight";
  StackFlight flight = imported(*folder);
  addMasks(flight, *folder / "labels" / "mask");
  const auto report = [&](const char* name, const Answers& answers) {
    return printed(name, qualityOf(answers, flight, kLearned, kEnd), kEnd - kLearned);
  };
  const auto compare = [&](const char* name, const Slowness& slowness, double share, int skip) {
    const Quality even =
        report("  every n-th frame not sent", runSlowly(flight, {}, everyNth(flight, kLearned, skip)));
    const Quality slow = report(name, runSlowly(flight, slowness));
    EXPECT_GE(slow.answered, share * (kEnd - kLearned) - 2) << name;
    EXPECT_LE(slow.latest_s, flight.configuration.waits.segmentation_s + 0.1) << name;
    EXPECT_GE(slow.found, even.found - 0.02) << name;
    EXPECT_LE(slow.false_area, even.false_area + 0.001) << name;
  };
  report("with time enough", runSlowly(flight, {}));
  compare("segmentation takes 1.25 periods", {{&kMotionSegmentation, 1.25}}, 0.8, 5);
  compare("segmentation takes 2 periods", {{&kMotionSegmentation, 2.0}}, 0.5, 2);
  compare("vision 1.25, segmentation 1.2 periods", {{&kVisualHomography, 1.25}, {&kMotionSegmentation, 1.2}},
          0.8, 5);
}

/// grove2 misses it (tests/benchmarks/RESULTS.md, "Overload").
INSTANTIATE_TEST_SUITE_P(Flights, RenderedOverload, testing::Values("park1"));

}  // namespace
}  // namespace redbee::test
