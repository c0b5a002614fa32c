// Faulty sensors that keep publishing.
#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <optional>
#include <random>
#include <utility>

#include "redbee/bus/image.hpp"
#include "tests/support/fault_trial.hpp"

namespace redbee::test {
namespace {

/// Frames of the disturbed stretch, of whose inertial message `holds`.
int countInertial(const StackOutput& output, const StackFlight& flight,
                  const std::function<bool(const inertial_homography_t&)>& holds) {
  int count = 0;
  for (int k = kFaultBegin; k < kFaultEnd; ++k) {
    const auto it = output.inertial.find(flight.frame_utimes[static_cast<size_t>(k)]);
    count += it != output.inertial.end() && holds(it->second) ? 1 : 0;
  }
  return count;
}
int complaints(const StackOutput& output, const StackFlight& flight) {
  return countInertial(output, flight, [](const auto& m) { return m.status != 0; });
}

StackFlight withChangedImu(const std::function<void(ins_t&)>& change) {
  return withChanged<ins_t>(undisturbedFlight(), "IMU", change);
}
StackFlight withChangedImages(const std::function<void(cv::Mat&)>& change) {
  return withChanged<image_t>(undisturbedFlight(), "CAMERA", [&](image_t& m) {
    cv::Mat grey = decodeGrey(m).value();
    change(grey);
    m = rawGreyMessage(m.utime, grey);
  });
}

TEST(SensorFault, ImuGaps) {
  StackFlight flight = undisturbedFlight();
  const int64_t begin = beginTime(flight);
  const auto is_in_gap = [&](const SensorMessage& a) {
    return a.channel == "IMU" && isDisturbed(flight, a.utime) && (a.utime - begin) % 300'000 < 200'000;
  };
  std::vector<SensorMessage> kept;
  for (const SensorMessage& a : flight.messages) {
    if (!is_in_gap(a)) kept.push_back(a);
  }
  flight.messages = kept;
  const StackOutput output = StackRun(flight).run();
  expectRecovery("IMU gaps of 0.2 s", output, flight, 24);
  EXPECT_GT(complaints(output, flight), 5);
}

TEST(SensorFault, ImuSpikes) {
  std::mt19937 random(3);
  int spikes = 0;
  const StackFlight flight = withChangedImu([&](ins_t& m) {
    if (random() % 40 != 0) return;
    ++spikes;
    const double sign = random() % 2 == 0 ? 1 : -1;
    m.gyro[random() % 3] += sign * 15;
    m.accel[random() % 3] += sign * 80;
  });
  const StackOutput output = StackRun(flight).run();
  const Damage damage = expectRecovery("IMU spikes, every 0.1 s", output, flight, 12);
  EXPECT_LT(damage.worst_px, 1.0);
  EXPECT_GT(spikes, 5);
  EXPECT_GT(complaints(output, flight), 5) << "the inertial status reports refused samples";
}

TEST(SensorFault, ImuSaturated) {
  const StackFlight flight = withChangedImu([](ins_t& m) {
    const double range = 2000 * M_PI / 180;
    m.gyro[2] = range;
    m.accel[0] = 16 * 9.80665;
  });
  const StackOutput output = StackRun(flight).run();
  const Damage damage = expectRecovery("IMU saturated", output, flight, 24);
  EXPECT_LT(damage.worst_px, 1.0);
  EXPECT_GT(complaints(output, flight), 15);
}

TEST(SensorFault, ImuStuck) {
  std::optional<ins_t> held;
  const StackFlight flight = withChangedImu([&](ins_t& m) {
    const int64_t utime = m.utime;
    if (!held) held = m;
    m = *held;
    m.utime = utime;
  });
  const StackOutput output = StackRun(flight).run();
  const Damage damage = expectRecovery("IMU stuck at one value", output, flight, 24);
  EXPECT_LT(damage.worst_px, 1.0);
  EXPECT_GT(complaints(output, flight), 12);
}

TEST(SensorFault, ImuAllZero) {
  const StackFlight flight = withChangedImu([](ins_t& m) {
    const int64_t utime = m.utime;
    m = ins_t{};
    m.utime = utime;
  });
  const StackOutput output = StackRun(flight).run();
  const Damage damage = expectRecovery("IMU at zero", output, flight, 24);
  EXPECT_LT(damage.worst_px, 1.0);
  EXPECT_GT(complaints(output, flight), 12);
}

TEST(SensorFault, ImuNotANumber) {
  const StackFlight flight =
      withChangedImu([](ins_t& m) { m.gyro[1] = std::numeric_limits<double>::quiet_NaN(); });
  const StackOutput output = StackRun(flight).run();
  expectRecovery("IMU not a number", output, flight, 24);
  EXPECT_GT(output.health.at("redbee-imu-integration").damaged, 100);
}

TEST(SensorFault, AltimeterWrong) {
  const StackFlight flight =
      withChanged<altimeter_t>(undisturbedFlight(), "ALTIMETER", [](altimeter_t& m) { m.height *= 3; });
  const Damage damage = expectRecovery("altimeter three times too high", StackRun(flight).run(), flight, 24);
  EXPECT_LT(damage.worst_px, 2) << "what the filter does not know any more is not published as known";
}

TEST(SensorFault, CameraFrozen) {
  std::optional<cv::Mat> held;
  const StackFlight flight = withChangedImages([&](cv::Mat& grey) {
    if (!held) held = grey.clone();
    grey = held->clone();
  });
  expectRecovery("camera frozen", StackRun(flight).run(), flight, 30);
}

TEST(SensorFault, CameraRepeatsEverySecondImage) {
  std::optional<cv::Mat> held;
  const StackFlight flight = withChangedImages([&](cv::Mat& grey) {
    if (held) {
      grey = *std::exchange(held, std::nullopt);
    } else {
      held = grey.clone();
    }
  });
  const Damage damage = expectRecovery("every second image repeated", StackRun(flight).run(), flight, 6);
  EXPECT_EQ(damage.without_homography, 0);
  EXPECT_EQ(damage.without_mask, 0);
  EXPECT_LT(damage.worst_px, 0.3) << "the repeated image is no measurement of the camera's motion";
}

TEST(SensorFault, ExposureJump) {
  const StackFlight flight = withChangedImages([](cv::Mat& grey) { grey.convertTo(grey, CV_8U, 1.8, 20); });
  // The background is learned again twice, when it grows bright and when it grows dark again: two seconds.
  expectRecovery("exposure 1.8 times as long", StackRun(flight).run(), flight, 48);
}

TEST(SensorFault, BlackFrames) {
  const StackFlight flight = withChangedImages([](cv::Mat& grey) { grey.setTo(0); });
  const StackOutput output = StackRun(flight).run();
  const Damage damage = expectRecovery("black frames", output, flight, 30);
  EXPECT_EQ(damage.without_mask, kFaultEnd - kFaultBegin) << "a black image has no GOOD mask";
}

TEST(SensorFault, NoiseInsteadOfImages) {
  cv::RNG random(5);
  const StackFlight flight =
      withChangedImages([&](cv::Mat& grey) { random.fill(grey, cv::RNG::UNIFORM, 0, 255); });
  const Damage damage = expectRecovery("noise instead of images", StackRun(flight).run(), flight, 30);
  EXPECT_EQ(damage.without_mask, kFaultEnd - kFaultBegin) << "noise has no GOOD mask";
}

TEST(SensorFault, CutShortJpegs) {
  const StackFlight flight = withChanged<image_t>(undisturbedFlight(), "CAMERA", [](image_t& m) {
    m = jpegMessage(m.utime, decodeGrey(m).value(), 80);
    m.data.resize(m.data.size() / 3);
    m.size = static_cast<int32_t>(m.data.size());
  });
  const Damage damage = expectRecovery("JPEGs cut short", StackRun(flight).run(), flight, 30);
  EXPECT_EQ(damage.without_mask, kFaultEnd - kFaultBegin) << "two thirds of each image were never there";
}

}  // namespace
}  // namespace redbee::test
