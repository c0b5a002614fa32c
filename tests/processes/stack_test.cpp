// The four nodes together on memq://, on simulated flights whose messages are disturbed in the ways a real
// bus and real drivers do.
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <opencv2/imgcodecs.hpp>

#include "redbee/configuration/process_table.hpp"
#include "redbee/geometry/so3.hpp"
#include "tests/support/stack_run.hpp"

namespace redbee::test {
namespace {

constexpr int kFrames = 60;

const StackFlight& undisturbed() {
  static const StackFlight flight = stackFlight(simulation::twoPlanes(3), kFrames);
  return flight;
}

const StackOutput& undisturbedOutput() {
  static const StackOutput output = StackRun(undisturbed()).run();
  return output;
}

bool isFrame(const SensorMessage& sent, const StackFlight& flight, int k) {
  return sent.channel == "CAMERA" && sent.utime == flight.frame_utimes[static_cast<size_t>(k)];
}

template <typename Predicate>
void drop(StackFlight& flight, const Predicate& predicate) {
  flight.messages.erase(std::remove_if(flight.messages.begin(), flight.messages.end(), predicate),
                        flight.messages.end());
}

size_t positionOf(const StackFlight& flight, int k) {
  const auto it = std::find_if(flight.messages.begin(), flight.messages.end(),
                               [&](const SensorMessage& sent) { return isFrame(sent, flight, k); });
  return static_cast<size_t>(it - flight.messages.begin());
}

/// Mean error of the ground homography over frames [from, to) that have one; how many lack one.
struct Accuracy {
  double mean_px = 0;
  int missing = 0;
};
Accuracy accuracy(const StackOutput& output, const StackFlight& flight, int from, int to) {
  Accuracy result;
  int count = 0;
  for (int k = from; k < to; ++k) {
    const auto fused = output.fused.find(flight.frame_utimes[static_cast<size_t>(k)]);
    if (fused == output.fused.end() || fused->second.source == 0) {
      ++result.missing;
      continue;
    }
    result.mean_px += groundError(fused->second, flight.homographies[static_cast<size_t>(k)]);
    ++count;
  }
  if (count > 0) result.mean_px /= count;
  return result;
}

int status(const StackOutput& output, const StackFlight& flight, int k) {
  const auto it = output.foreground.find(flight.frame_utimes[static_cast<size_t>(k)]);
  return it == output.foreground.end() ? -1 : it->second.status;
}

/// Pixels of the published mask that are background in the ground truth.
int falsePixels(const StackOutput& output, const StackFlight& flight, int k) {
  const auto& foreground = output.foreground.at(flight.frame_utimes[static_cast<size_t>(k)]);
  const cv::Mat mask = cv::imdecode(foreground.mask, cv::IMREAD_GRAYSCALE);
  const cv::Mat truth = flight.masks[static_cast<size_t>(k)];
  return cv::countNonZero(mask & (truth == 0));
}

/// No GOOD mask has more than a few percent of false area.
void expectNoWrongMaskCalledGood(const StackOutput& output, const StackFlight& flight) {
  for (int k = 0; k < static_cast<int>(flight.frame_utimes.size()); ++k) {
    if (status(output, flight, k) != 0) continue;
    EXPECT_LT(falsePixels(output, flight, k), 640 * 480 / 25) << "frame " << k;
  }
}

void expectRecovered(const StackOutput& output, const StackFlight& flight, int from) {
  const Accuracy end = accuracy(output, flight, from, kFrames);
  EXPECT_EQ(end.missing, 0);
  EXPECT_LT(end.mean_px, 0.3);
  for (int k = from; k < kFrames; ++k) EXPECT_EQ(status(output, flight, k), 0) << "frame " << k;
}

TEST(Stack, FollowsTheGroundAndPublishesEveryFrame) {
  const StackOutput& output = undisturbedOutput();
  const Accuracy all = accuracy(output, undisturbed(), 1, kFrames);
  std::cout << "fused ground homography: " << all.mean_px << " px mean transfer error over " << kFrames - 1
            << " frames\n";
  EXPECT_EQ(all.missing, 0);
  EXPECT_LT(all.mean_px, 0.2);
  EXPECT_EQ(output.foreground.size(), static_cast<size_t>(kFrames));
  EXPECT_EQ(output.detections.size(), static_cast<size_t>(kFrames));
  expectNoWrongMaskCalledGood(output, undisturbed());
  for (const auto& [process, health] : output.health) {
    EXPECT_EQ(health.lost + health.damaged + health.skipped + health.late, 0) << process;
  }
}

TEST(Stack, TwoRunsAgreeToTheBit) {
  const StackOutput& first = undisturbedOutput();
  const StackOutput second = StackRun(undisturbed()).run();
  for (const auto& [utime, foreground] : first.foreground) {
    EXPECT_EQ(foreground.mask, second.foreground.at(utime).mask);
    EXPECT_EQ(foreground.probability, second.foreground.at(utime).probability);
    EXPECT_TRUE(std::equal(std::begin(first.fused.at(utime).step.H), std::end(first.fused.at(utime).step.H),
                           std::begin(second.fused.at(utime).step.H)));
  }
}

TEST(Stack, AFrameThatComesTwiceChangesNothing) {
  StackFlight flight = undisturbed();
  const size_t at = positionOf(flight, 30);
  const SensorMessage again = flight.messages[at];
  flight.messages.insert(flight.messages.begin() + static_cast<long>(at) + 5, again);
  const StackOutput output = StackRun(flight).run();
  const StackOutput& expected = undisturbedOutput();
  for (const auto& [utime, foreground] : expected.foreground) {
    EXPECT_EQ(foreground.mask, output.foreground.at(utime).mask);
  }
  EXPECT_EQ(output.health.at("redbee-visual-homography").skipped, 0) << "no frame was left out";
}

TEST(Stack, AFrameThatIsLostIsBridged) {
  StackFlight flight = undisturbed();
  drop(flight, [&](const SensorMessage& sent) { return isFrame(sent, flight, 30); });
  const StackOutput output = StackRun(flight).run();
  expectNoWrongMaskCalledGood(output, flight);
  expectRecovered(output, flight, 45);
}

TEST(Stack, FramesOutOfOrderAreRecoveredFrom) {
  StackFlight flight = undisturbed();
  const size_t a = positionOf(flight, 30);
  const size_t b = positionOf(flight, 31);
  std::swap(flight.messages[a], flight.messages[b]);
  const StackOutput output = StackRun(flight).run();
  expectNoWrongMaskCalledGood(output, flight);
  expectRecovered(output, flight, 45);
}

TEST(Stack, AnImuGapIsBridgedByVision) {
  StackFlight flight = undisturbed();
  const int64_t from = flight.frame_utimes[20];
  const int64_t to = flight.frame_utimes[36];
  drop(flight, [&](const SensorMessage& a) { return a.channel == "IMU" && a.utime > from && a.utime < to; });
  const StackOutput output = StackRun(flight).run();
  EXPECT_EQ(accuracy(output, flight, 1, kFrames).missing, 0);
  bool degraded = false;
  for (int k = 20; k < 38; ++k) {
    degraded |= output.inertial.at(flight.frame_utimes[static_cast<size_t>(k)]).status != 0;
  }
  EXPECT_TRUE(degraded) << "the inertial status reports missing samples";
  expectNoWrongMaskCalledGood(output, flight);
  expectRecovered(output, flight, 50);
}

TEST(Stack, RunsWithoutAnImu) {
  StackFlight flight = undisturbed();
  flight.configuration.has_imu = false;
  drop(flight, [](const SensorMessage& a) { return a.channel != "CAMERA"; });
  const StackOutput output = StackRun(flight).run();
  const Accuracy all = accuracy(output, flight, 1, kFrames);
  EXPECT_EQ(all.missing, 0);
  EXPECT_EQ(output.foreground.size(), static_cast<size_t>(kFrames));
}

TEST(Stack, AClockThatIsSetBackRestarts) {
  StackFlight flight = undisturbed();
  const size_t at = positionOf(flight, 30);
  const int64_t jump = -3'600'000'000;
  for (size_t i = at; i < flight.messages.size(); ++i) {
    SensorMessage& sent = flight.messages[i];
    sent.utime += jump;
    if (sent.channel == "CAMERA") {
      image_t m;
      ASSERT_TRUE(decodeMessage(sent.data.data(), static_cast<int>(sent.data.size()), m));
      m.utime += jump;
      sent = encoded(m);
    } else if (sent.channel == "IMU") {
      ins_t m;
      ASSERT_TRUE(decodeMessage(sent.data.data(), static_cast<int>(sent.data.size()), m));
      m.utime += jump;
      sent = encoded(m);
    } else {
      altimeter_t m;
      ASSERT_TRUE(decodeMessage(sent.data.data(), static_cast<int>(sent.data.size()), m));
      m.utime += jump;
      sent = encoded(m);
    }
  }
  for (int k = 30; k < kFrames; ++k) flight.frame_utimes[static_cast<size_t>(k)] += jump;
  const StackOutput output = StackRun(flight).run();
  EXPECT_NE(status(output, flight, 30), 0) << "the first frame after the jump has no GOOD mask";
  expectNoWrongMaskCalledGood(output, flight);
  expectRecovered(output, flight, 50);
}

TEST(Stack, ImagesOfAnotherSizeAreRefusedAndRecoveredFrom) {
  StackFlight flight = undisturbed();
  for (int k = 30; k < 33; ++k) {
    SensorMessage& sent = flight.messages[positionOf(flight, k)];
    sent = encoded(rawGreyMessage(sent.utime, cv::Mat(240, 320, CV_8U, cv::Scalar(90))));
  }
  const StackOutput output = StackRun(flight).run();
  for (int k = 30; k < 33; ++k) EXPECT_NE(status(output, flight, k), 0) << "frame " << k;
  expectNoWrongMaskCalledGood(output, flight);
  expectRecovered(output, flight, 50);
}

TEST(Stack, ACalibrationThatDoesNotFitIsReported) {
  const StackOutput& right = undisturbedOutput();
  StackFlight flight = undisturbed();
  flight.configuration.inertial.extrinsics.R_CI =
      expSO3({0, 0, M_PI / 2}) *
      flight.configuration.inertial.extrinsics.R_CI;  // axes swapped, the usual mistake
  const StackOutput wrong = StackRun(flight).run();
  // The fusion decides; its message passes the result on to other processes.
  for (const ProcessDescription* process : {&kImuIntegration, &kHomographyFusion, &kMotionSegmentation}) {
    EXPECT_EQ(right.health.at(programName(*process)).calibration, "fits") << process->name;
    EXPECT_NE(wrong.health.at(programName(*process)).calibration, "fits") << process->name;
  }
}

TEST(Stack, RandomBytesOnEveryChannelAreCountedAndChangeNothing) {
  StackFlight flight = undisturbed();
  const std::vector<uint8_t> rubbish(300, 0x5A);
  const size_t at = positionOf(flight, 30);
  for (const char* channel :
       {"CAMERA", "IMU", "ALTIMETER", "INERTIAL_HOMOGRAPHY", "VISUAL_HOMOGRAPHY", "FUSED_HOMOGRAPHY"}) {
    flight.messages.insert(flight.messages.begin() + static_cast<long>(at), {0, channel, rubbish});
  }
  const StackOutput output = StackRun(flight).run();
  const StackOutput& expected = undisturbedOutput();
  for (const auto& [utime, foreground] : expected.foreground) {
    EXPECT_EQ(foreground.mask, output.foreground.at(utime).mask);
  }
  EXPECT_GT(output.health.at("redbee-motion-segmentation").damaged, 0);
}

}  // namespace
}  // namespace redbee::test
