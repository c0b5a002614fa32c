// The four nodes together on memq://, on simulated flights whose arrivals are disturbed in the ways a real
// bus and real drivers do.
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <opencv2/imgcodecs.hpp>

#include "redbee/geometry/so3.hpp"
#include "tests/processes/stack_fixture.hpp"

namespace redbee::test {
namespace {

constexpr int kFrames = 60;

const Flight& undisturbed() {
  static const Flight flight = fly(simulation::twoPlanes(3), kFrames);
  return flight;
}

const Said& undisturbedAnswer() {
  static const Said said = run(undisturbed());
  return said;
}

bool isFrame(const Arrival& arrival, const Flight& flight, int k) {
  return arrival.channel == "CAMERA" && arrival.utime == flight.frame_utimes[static_cast<size_t>(k)];
}

template <typename Predicate>
void drop(Flight& flight, const Predicate& predicate) {
  flight.arrivals.erase(std::remove_if(flight.arrivals.begin(), flight.arrivals.end(), predicate),
                        flight.arrivals.end());
}

size_t positionOf(const Flight& flight, int k) {
  const auto it = std::find_if(flight.arrivals.begin(), flight.arrivals.end(),
                               [&](const Arrival& arrival) { return isFrame(arrival, flight, k); });
  return static_cast<size_t>(it - flight.arrivals.begin());
}

/// Mean error of the ground homography over frames [from, to) that have one; how many lack one.
struct Accuracy {
  double mean_px = 0;
  int missing = 0;
};
Accuracy accuracy(const Said& said, const Flight& flight, int from, int to) {
  Accuracy result;
  int count = 0;
  for (int k = from; k < to; ++k) {
    const auto fused = said.fused.find(flight.frame_utimes[static_cast<size_t>(k)]);
    if (fused == said.fused.end() || fused->second.source == 0) {
      ++result.missing;
      continue;
    }
    result.mean_px += groundError(fused->second, flight.homographies[static_cast<size_t>(k)]);
    ++count;
  }
  if (count > 0) result.mean_px /= count;
  return result;
}

int status(const Said& said, const Flight& flight, int k) {
  const auto it = said.foreground.find(flight.frame_utimes[static_cast<size_t>(k)]);
  return it == said.foreground.end() ? -1 : it->second.status;
}

/// Pixels of the published mask that the truth says are background.
int falsePixels(const Said& said, const Flight& flight, int k) {
  const auto& foreground = said.foreground.at(flight.frame_utimes[static_cast<size_t>(k)]);
  const cv::Mat mask = cv::imdecode(foreground.mask, cv::IMREAD_GRAYSCALE);
  const cv::Mat truth = flight.masks[static_cast<size_t>(k)];
  return cv::countNonZero(mask & (truth == 0));
}

/// No mask of a frame that is called good is wilder than a few percent of the image.
void expectNoWrongMaskCalledGood(const Said& said, const Flight& flight) {
  for (int k = 0; k < static_cast<int>(flight.frame_utimes.size()); ++k) {
    if (status(said, flight, k) != 0) continue;
    EXPECT_LT(falsePixels(said, flight, k), 640 * 480 / 25) << "frame " << k;
  }
}

void expectRecovered(const Said& said, const Flight& flight, int from) {
  const Accuracy end = accuracy(said, flight, from, kFrames);
  EXPECT_EQ(end.missing, 0);
  EXPECT_LT(end.mean_px, 0.3);
  for (int k = from; k < kFrames; ++k) EXPECT_EQ(status(said, flight, k), 0) << "frame " << k;
}

TEST(Stack, FollowsTheGroundAndAnswersEveryFrame) {
  const Said& said = undisturbedAnswer();
  const Accuracy all = accuracy(said, undisturbed(), 1, kFrames);
  std::cout << "fused ground homography: " << all.mean_px << " px mean transfer error over " << kFrames - 1
            << " frames\n";
  EXPECT_EQ(all.missing, 0);
  EXPECT_LT(all.mean_px, 0.2);
  EXPECT_EQ(said.foreground.size(), static_cast<size_t>(kFrames));
  EXPECT_EQ(said.detections.size(), static_cast<size_t>(kFrames));
  expectNoWrongMaskCalledGood(said, undisturbed());
  for (const auto& [process, health] : said.health) {
    EXPECT_EQ(health.lost + health.damaged + health.skipped + health.late, 0) << process;
  }
}

TEST(Stack, TwoRunsAgreeToTheBit) {
  const Said& first = undisturbedAnswer();
  const Said second = run(undisturbed());
  for (const auto& [utime, foreground] : first.foreground) {
    EXPECT_EQ(foreground.mask, second.foreground.at(utime).mask);
    EXPECT_EQ(foreground.probability, second.foreground.at(utime).probability);
    EXPECT_TRUE(std::equal(std::begin(first.fused.at(utime).H), std::end(first.fused.at(utime).H),
                           std::begin(second.fused.at(utime).H)));
  }
}

TEST(Stack, AFrameThatComesTwiceChangesNothing) {
  Flight flight = undisturbed();
  const size_t at = positionOf(flight, 30);
  const Arrival again = flight.arrivals[at];
  flight.arrivals.insert(flight.arrivals.begin() + static_cast<long>(at) + 5, again);
  const Said said = run(flight);
  const Said& expected = undisturbedAnswer();
  for (const auto& [utime, foreground] : expected.foreground) {
    EXPECT_EQ(foreground.mask, said.foreground.at(utime).mask);
  }
  EXPECT_GT(said.health.at("redbee-visual-homography").skipped, 0) << "and the health says so";
}

TEST(Stack, AFrameThatIsLostIsBridged) {
  Flight flight = undisturbed();
  drop(flight, [&](const Arrival& arrival) { return isFrame(arrival, flight, 30); });
  const Said said = run(flight);
  expectNoWrongMaskCalledGood(said, flight);
  expectRecovered(said, flight, 45);
}

TEST(Stack, FramesOutOfOrderAreRecoveredFrom) {
  Flight flight = undisturbed();
  const size_t a = positionOf(flight, 30);
  const size_t b = positionOf(flight, 31);
  std::swap(flight.arrivals[a], flight.arrivals[b]);
  const Said said = run(flight);
  expectNoWrongMaskCalledGood(said, flight);
  expectRecovered(said, flight, 45);
}

TEST(Stack, AnImuGapIsBridgedByVision) {
  Flight flight = undisturbed();
  const int64_t from = flight.frame_utimes[20];
  const int64_t to = flight.frame_utimes[36];
  drop(flight, [&](const Arrival& a) { return a.channel == "IMU" && a.utime > from && a.utime < to; });
  const Said said = run(flight);
  EXPECT_EQ(accuracy(said, flight, 1, kFrames).missing, 0);
  bool degraded = false;
  for (int k = 20; k < 38; ++k) {
    degraded |= said.inertial.at(flight.frame_utimes[static_cast<size_t>(k)]).status != 0;
  }
  EXPECT_TRUE(degraded) << "the inertial messages say that samples are missing";
  expectNoWrongMaskCalledGood(said, flight);
  expectRecovered(said, flight, 50);
}

TEST(Stack, RunsWithoutAnImu) {
  Flight flight = undisturbed();
  flight.configuration.has_imu = false;
  drop(flight, [](const Arrival& a) { return a.channel != "CAMERA"; });
  const Said said = run(flight);
  const Accuracy all = accuracy(said, flight, 1, kFrames);
  EXPECT_EQ(all.missing, 0);
  EXPECT_EQ(said.foreground.size(), static_cast<size_t>(kFrames));
}

TEST(Stack, AClockThatIsSetBackRestarts) {
  Flight flight = undisturbed();
  const size_t at = positionOf(flight, 30);
  const int64_t jump = -3'600'000'000;
  for (size_t i = at; i < flight.arrivals.size(); ++i) {
    Arrival& arrival = flight.arrivals[i];
    arrival.utime += jump;
    if (arrival.channel == "CAMERA") {
      image_t m;
      ASSERT_TRUE(decodeMessage(arrival.data.data(), static_cast<int>(arrival.data.size()), m));
      m.utime += jump;
      arrival = arrivalOf(m);
    } else if (arrival.channel == "IMU") {
      ins_t m;
      ASSERT_TRUE(decodeMessage(arrival.data.data(), static_cast<int>(arrival.data.size()), m));
      m.utime += jump;
      arrival = arrivalOf(m);
    } else {
      altimeter_t m;
      ASSERT_TRUE(decodeMessage(arrival.data.data(), static_cast<int>(arrival.data.size()), m));
      m.utime += jump;
      arrival = arrivalOf(m);
    }
  }
  for (int k = 30; k < kFrames; ++k) flight.frame_utimes[static_cast<size_t>(k)] += jump;
  const Said said = run(flight);
  EXPECT_NE(status(said, flight, 30), 0) << "the first frame after the jump has no trusted mask";
  expectNoWrongMaskCalledGood(said, flight);
  expectRecovered(said, flight, 50);
}

TEST(Stack, ImagesOfAnotherSizeAreRefusedAndRecoveredFrom) {
  Flight flight = undisturbed();
  for (int k = 30; k < 33; ++k) {
    Arrival& arrival = flight.arrivals[positionOf(flight, k)];
    arrival = arrivalOf(rawGreyMessage(arrival.utime, cv::Mat(240, 320, CV_8U, cv::Scalar(90))));
  }
  const Said said = run(flight);
  for (int k = 30; k < 33; ++k) EXPECT_NE(status(said, flight, k), 0) << "frame " << k;
  expectNoWrongMaskCalledGood(said, flight);
  expectRecovered(said, flight, 50);
}

TEST(Stack, ACalibrationThatDoesNotFitIsReported) {
  const Said& right = undisturbedAnswer();
  Flight flight = undisturbed();
  flight.configuration.inertial.extrinsics.R_CI =
      expSO3({0, 0, M_PI / 2}) *
      flight.configuration.inertial.extrinsics.R_CI;  // axes swapped, the usual mistake
  const Said wrong = run(flight);
  for (const char* process :
       {"redbee-imu-integration", "redbee-homography-fusion", "redbee-motion-segmentation"}) {
    EXPECT_EQ(right.health.at(process).calibration, "fits") << process;
    EXPECT_NE(wrong.health.at(process).calibration, "fits") << process;
    std::cout << process << ": " << wrong.health.at(process).calibration << '\n';
  }
}

TEST(Stack, RandomBytesOnEveryChannelAreCountedAndChangeNothing) {
  Flight flight = undisturbed();
  const std::vector<uint8_t> rubbish(300, 0x5A);
  const size_t at = positionOf(flight, 30);
  for (const char* channel :
       {"CAMERA", "IMU", "ALTIMETER", "INERTIAL_HOMOGRAPHY", "VISUAL_HOMOGRAPHY", "FUSED_HOMOGRAPHY"}) {
    flight.arrivals.insert(flight.arrivals.begin() + static_cast<long>(at), {0, channel, rubbish});
  }
  const Said said = run(flight);
  const Said& expected = undisturbedAnswer();
  for (const auto& [utime, foreground] : expected.foreground) {
    EXPECT_EQ(foreground.mask, said.foreground.at(utime).mask);
  }
  EXPECT_GT(said.health.at("redbee-motion-segmentation").damaged, 0);
}

}  // namespace
}  // namespace redbee::test
