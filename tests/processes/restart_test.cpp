// A process of the stack is killed during a flight and restarted: in flight time, so reproducible on every
// machine. tests/integration/survives_kills includes supervisor.
#include <gtest/gtest.h>

#include <fstream>
#include <iostream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "processes/conversions.hpp"
#include "processes/motion_segmentation/node.hpp"
#include "tests/support/killable_stack.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/stack_run.hpp"

namespace redbee::test {
namespace {

constexpr int kFrames = 110;
constexpr int kKilledAt = 50;
constexpr int kDownFrames = 8;  ///< a third of a second: what supervisor needs

struct RunResult {
  /// By frame time: the newest frame that had been sent when its mask was published.
  std::map<int64_t, int> published_at;
  StackOutput output;
};

/// `kills`: the process killed at each frame; it is restarted kDownFrames later.
RunResult flyWith(const StackFlight& flight, const std::map<int, const ProcessDescription*>& kills) {
  const auto bus = makeLcmBus("memq://");
  RunResult result;
  int frame = -1;
  const std::vector<Subscription> output = result.output.subscribe(*bus);
  const Subscription times = bus->subscribe<foreground_t>(
      "FOREGROUND", 64, [&](const foreground_t& m) { result.published_at[m.utime] = frame; });
  KillableStack stack(*bus, flight.configuration);
  for (const SensorMessage& sent : flight.messages) {
    if (sent.channel == "CAMERA") {
      ++frame;
      if (const auto kill = kills.find(frame); kill != kills.end()) stack.kill(*kill->second);
      if (const auto kill = kills.find(frame - kDownFrames); kill != kills.end()) stack.start(*kill->second);
    }
    bus->publish(sent.channel, sent.data);
    stack.settle();
  }
  return result;
}

const StackFlight& walk() {
  static const StackFlight flight = stackFlight(simulation::twoPlanes(3), kFrames);
  return flight;
}

int64_t utimeOf(int k) { return walk().frame_utimes[static_cast<size_t>(k)]; }

bool isGood(const StackOutput& output, int k) {
  const auto it = output.foreground.find(utimeOf(k));
  return it != output.foreground.end() && it->second.status == 0;
}

/// Longest time without a GOOD mask, in frames sent: what an autopilot observes.
int framesWithoutMask(const RunResult& result, int killed_at) {
  int longest = 0;
  int last = killed_at;
  for (int k = killed_at; k < kFrames; ++k) {
    if (!isGood(result.output, k)) continue;
    longest = std::max(longest, result.published_at.at(utimeOf(k)) - last);
    last = std::max(last, result.published_at.at(utimeOf(k)));
  }
  return longest;
}

int untrusted(const StackOutput& output, int from, int to) {
  int count = 0;
  for (int k = from; k < to; ++k) count += isGood(output, k) ? 0 : 1;
  return count;
}

/// No GOOD mask has more than a few percent of false area.
void expectNoWrongMask(const StackOutput& output) {
  for (int k = 0; k < kFrames; ++k) {
    if (!isGood(output, k)) continue;
    const cv::Mat mask = cv::imdecode(output.foreground.at(utimeOf(k)).mask, cv::IMREAD_GRAYSCALE);
    EXPECT_LT(cv::countNonZero(mask & (walk().masks[static_cast<size_t>(k)] == 0)), 640 * 480 / 25)
        << "frame " << k;
  }
}

/// Identities of what is detected at frame k, by the truth's mover: here there is one.
std::optional<int> identityAt(const StackOutput& output, int k) {
  const auto it = output.detections.find(utimeOf(k));
  if (it == output.detections.end()) return std::nullopt;
  const cv::Rect truth = cv::boundingRect(walk().masks[static_cast<size_t>(k)] == 255);
  for (const detection_t& d : it->second.detections) {
    const cv::Rect box(d.x, d.y, d.width, d.height);
    if (d.seen != 0 && (box & truth).area() > 0.3 * (box | truth).area()) return d.id;
  }
  return std::nullopt;
}

std::optional<int> firstIdentity(const StackOutput& output, int from, int to, int step = 1) {
  for (int k = from; k != to; k += step) {
    if (const auto id = identityAt(output, k)) return id;
  }
  return std::nullopt;
}

struct Case {
  const char* name;
  const ProcessDescription* killed;
  int without_mask;  ///< frames in a row at most, 24 a second
  int never;         ///< limit of the number of frames that never get a GOOD mask
};

class ProcessKilled : public testing::TestWithParam<Case> {};

TEST_P(ProcessKilled, TheOthersContinueAndNoWrongMaskIsPublished) {
  const Case& c = GetParam();
  const RunResult result = flyWith(walk(), {{kKilledAt, c.killed}});
  expectNoWrongMask(result.output);
  const int without_mask = framesWithoutMask(result, kKilledAt - 1);
  const int lost = untrusted(result.output, kKilledAt, kFrames - 10);
  std::cout << c.name << ": " << without_mask << " frames without a GOOD mask, " << lost
            << " never got one\n";
  EXPECT_LE(without_mask, c.without_mask);
  EXPECT_LE(lost, c.never);
  const auto before = firstIdentity(result.output, kKilledAt - 1, kKilledAt - 15, -1);
  const auto after = firstIdentity(result.output, kKilledAt + 1, kFrames);
  ASSERT_TRUE(before && after);
  if (c.killed != &kMotionSegmentation) {
    EXPECT_EQ(*before, *after);
  }
}

INSTANTIATE_TEST_SUITE_P(Each, ProcessKilled,
                         testing::Values(Case{"imu", &kImuIntegration, 12, 0},
                                         Case{"visual", &kVisualHomography, 12, 0},
                                         Case{"fusion", &kHomographyFusion, 12, 0},
                                         Case{"segmentation", &kMotionSegmentation, 24, 16}),
                         [](const auto& each) { return each.param.name; });

/// As on an overloaded machine: inertial homographies arrive in time, visual ones do not, and the filter's
/// velocity is unknown.
TEST(ProcessesStart, WithoutVisionNoWrongMaskIsGood) {
  const RunResult result = flyWith(walk(), {{0, &kVisualHomography}});
  expectNoWrongMask(result.output);
  for (int k = 0; k < kDownFrames; ++k) EXPECT_FALSE(isGood(result.output, k)) << "frame " << k;
  EXPECT_EQ(untrusted(result.output, kKilledAt, kFrames), 0);
}

TEST(RestartedTracker, NeverReusesAnIdentity) {
  const ScratchFolder folder;
  TrackIdStore first(folder.path() / "identities");
  EXPECT_EQ(first.globalId(1), 1);
  EXPECT_EQ(first.globalId(7), 7);
  EXPECT_EQ(first.globalId(3), 3);
  TrackIdStore second(folder.path() / "identities");
  EXPECT_EQ(second.globalId(1), 8);
  TrackIdStore third(folder.path() / "identities");
  EXPECT_EQ(third.globalId(2), 10);
}

TEST(RestartedTracker, FileErrorsDoNotEndTheFlight) {
  const ScratchFolder folder;
  std::ofstream(folder.path() / "identities") << "seven";
  EXPECT_EQ(TrackIdStore(folder.path() / "identities").globalId(1), 1);
  TrackIdStore nowhere(folder.path() / "no such folder" / "identities");
  EXPECT_EQ(nowhere.globalId(1), 1);
  EXPECT_EQ(nowhere.globalId(2), 2);
}

TEST(RestartedFusion, ItsAnchorIsNotTakenForTheOldOne) {
  const auto bus = makeLcmBus("memq://");
  std::map<int64_t, int8_t> status;
  const Subscription subscription = bus->subscribe<foreground_t>(
      "FOREGROUND", 64, [&](const foreground_t& m) { status[m.utime] = m.status; });
  MotionSegmentationNode node(*bus, walk().configuration);
  const auto publish = [&](int k, int64_t utime_previous, int64_t utime_anchor) {
    fused_homography_t fused{};
    fused.utime = utimeOf(k);
    fused.utime_previous = utime_previous;
    fused.sequence = k;
    fused.source = static_cast<int8_t>(FusionSource::kVisual);
    fused.epoch = 1;
    fused.utime_anchor = utime_anchor;
    fused.width = walk().configuration.camera.width;
    fused.height = walk().configuration.camera.height;
    fill(fused.step.H, walk().homographies[static_cast<size_t>(k)]);
    fill(fused.anchor.H, walk().homographies[static_cast<size_t>(k)]);
    bus->publish("FUSED_HOMOGRAPHY", fused);
    for (const SensorMessage& sent : walk().messages) {
      if (sent.channel == "CAMERA" && sent.utime == utimeOf(k)) bus->publish(sent.channel, sent.data);
    }
    bus->handle(std::chrono::milliseconds(0));
    node.process();
    bus->handle(std::chrono::milliseconds(0));
  };
  for (int k = 1; k < 15; ++k) publish(k, utimeOf(k - 1), utimeOf(0));
  EXPECT_EQ(status.at(utimeOf(14)), 0);
  publish(17, utimeOf(16), utimeOf(16));  // frames were lost, and the fusion counts its epochs from the start
  node.finish();
  bus->handle(std::chrono::milliseconds(0));
  EXPECT_NE(status.at(utimeOf(17)), 0) << "the homographies to two different anchors do not compose";
}

}  // namespace
}  // namespace redbee::test
