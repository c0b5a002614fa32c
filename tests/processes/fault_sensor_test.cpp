// What sensors do to the stack when they fail without falling silent.
#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <random>

#include "redbee/bus/image.hpp"
#include "tests/processes/fault_trial.hpp"

namespace redbee::test {
namespace {

/// Frames of the disturbed stretch, of whose inertial message `holds`.
int countInertial(const Said& said, const Flight& flight,
                  const std::function<bool(const inertial_homography_t&)>& holds) {
  int count = 0;
  for (int k = kFaultBegin; k < kFaultEnd; ++k) {
    const auto it = said.inertial.find(flight.frame_utimes[static_cast<size_t>(k)]);
    count += it != said.inertial.end() && holds(it->second) ? 1 : 0;
  }
  return count;
}
int complaints(const Said& said, const Flight& flight) {
  return countInertial(said, flight, [](const auto& m) { return m.status != 0; });
}

Flight withChangedImu(const std::function<void(ins_t&)>& change) {
  return withChanged<ins_t>(calmFlight(), "IMU", change);
}
Flight withChangedImages(const std::function<void(cv::Mat&)>& change) {
  return withChanged<image_t>(calmFlight(), "CAMERA", [&](image_t& m) {
    cv::Mat grey = decodeGrey(m).value();
    change(grey);
    m = rawGreyMessage(m.utime, grey);
  });
}

TEST(SensorFault, ImuGaps) {
  Flight flight = calmFlight();
  const int64_t begin = beginTime(flight);
  const auto is_in_gap = [&](const Arrival& a) {
    return a.channel == "IMU" && isDisturbed(flight, a.utime) && (a.utime - begin) % 300'000 < 200'000;
  };
  std::vector<Arrival> kept;
  for (const Arrival& a : flight.arrivals) {
    if (!is_in_gap(a)) kept.push_back(a);
  }
  flight.arrivals = kept;
  const Said said = run(flight);
  expectRecovery("IMU gaps of 0.2 s", said, flight, 24);
  EXPECT_GT(complaints(said, flight), 5);
}

TEST(SensorFault, ImuSpikes) {
  std::mt19937 random(3);
  int spikes = 0;
  const Flight flight = withChangedImu([&](ins_t& m) {
    if (random() % 40 != 0) return;
    ++spikes;
    const double sign = random() % 2 == 0 ? 1 : -1;
    m.gyro[random() % 3] += sign * 15;
    m.accel[random() % 3] += sign * 80;
  });
  const Said said = run(flight);
  const Damage damage = expectRecovery("IMU spikes, every 0.1 s", said, flight, 12);
  EXPECT_LT(damage.worst_px, 1.0);
  EXPECT_GT(spikes, 5);
  EXPECT_GT(complaints(said, flight), 5) << "the inertial messages say that samples were refused";
}

TEST(SensorFault, ImuSaturated) {
  const Flight flight = withChangedImu([](ins_t& m) {
    const double range = 2000 * M_PI / 180;
    m.gyro[2] = range;
    m.accel[0] = 16 * 9.80665;
  });
  const Said said = run(flight);
  const Damage damage = expectRecovery("IMU saturated", said, flight, 24);
  EXPECT_LT(damage.worst_px, 1.0);
  EXPECT_GT(complaints(said, flight), 15);
}

TEST(SensorFault, ImuStuck) {
  std::optional<ins_t> held;
  const Flight flight = withChangedImu([&](ins_t& m) {
    const int64_t utime = m.utime;
    if (!held) held = m;
    m = *held;
    m.utime = utime;
  });
  const Said said = run(flight);
  const Damage damage = expectRecovery("IMU stuck at one value", said, flight, 24);
  EXPECT_LT(damage.worst_px, 1.0);
  EXPECT_GT(complaints(said, flight), 12);
}

TEST(SensorFault, ImuAllZero) {
  const Flight flight = withChangedImu([](ins_t& m) {
    const int64_t utime = m.utime;
    m = ins_t{};
    m.utime = utime;
  });
  const Said said = run(flight);
  const Damage damage = expectRecovery("IMU says zero", said, flight, 24);
  EXPECT_LT(damage.worst_px, 1.0);
  EXPECT_GT(complaints(said, flight), 12);
}

TEST(SensorFault, ImuNotANumber) {
  const Flight flight =
      withChangedImu([](ins_t& m) { m.gyro[1] = std::numeric_limits<double>::quiet_NaN(); });
  const Said said = run(flight);
  expectRecovery("IMU says NaN", said, flight, 24);
  EXPECT_GT(said.health.at("redbee-imu-integration").damaged, 100);
}

TEST(SensorFault, AltimeterWrong) {
  const Flight flight =
      withChanged<altimeter_t>(calmFlight(), "ALTIMETER", [](altimeter_t& m) { m.height *= 3; });
  const Damage damage = expectRecovery("altimeter three times too high", run(flight), flight, 24);
  EXPECT_LT(damage.worst_px, 2) << "what the filter does not know any more is not told as known";
}

TEST(SensorFault, CameraFrozen) {
  std::optional<cv::Mat> held;
  const Flight flight = withChangedImages([&](cv::Mat& grey) {
    if (!held) held = grey.clone();
    grey = held->clone();
  });
  expectRecovery("camera frozen", run(flight), flight, 30);
}

TEST(SensorFault, ExposureJump) {
  const Flight flight = withChangedImages([](cv::Mat& grey) { grey.convertTo(grey, CV_8U, 1.8, 20); });
  // The background is learned anew twice, when it grows bright and when it grows dark again: two seconds.
  expectRecovery("exposure 1.8 times as long", run(flight), flight, 48);
}

TEST(SensorFault, BlackFrames) {
  const Flight flight = withChangedImages([](cv::Mat& grey) { grey.setTo(0); });
  const Said said = run(flight);
  const Damage damage = expectRecovery("black frames", said, flight, 30);
  EXPECT_EQ(damage.without_mask, kFaultEnd - kFaultBegin) << "a black image has no trusted mask";
}

TEST(SensorFault, NoiseInsteadOfImages) {
  cv::RNG random(5);
  const Flight flight =
      withChangedImages([&](cv::Mat& grey) { random.fill(grey, cv::RNG::UNIFORM, 0, 255); });
  const Damage damage = expectRecovery("noise instead of images", run(flight), flight, 30);
  EXPECT_EQ(damage.without_mask, kFaultEnd - kFaultBegin) << "noise has no trusted mask";
}

TEST(SensorFault, CutShortJpegs) {
  const Flight flight = withChanged<image_t>(calmFlight(), "CAMERA", [](image_t& m) {
    m = jpegMessage(m.utime, decodeGrey(m).value(), 80);
    m.data.resize(m.data.size() / 3);
    m.size = static_cast<int32_t>(m.data.size());
  });
  const Damage damage = expectRecovery("JPEGs cut short", run(flight), flight, 30);
  EXPECT_EQ(damage.without_mask, kFaultEnd - kFaultBegin) << "two thirds of each image were never there";
}

}  // namespace
}  // namespace redbee::test
