// The pre-flight check on channels that a test publishes.
#include "processes/redbee/vehicle/live_check.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <opencv2/imgproc.hpp>
#include <random>

#include "processes/redbee/vehicle/live_findings.hpp"
#include "redbee/bus/image.hpp"
#include "tests/support/fault_trial.hpp"
#include "tests/support/scratch_folder.hpp"

namespace redbee::test {
namespace {

/// The line that begins with `name`.
Finding lineOf(const std::vector<Finding>& findings, const std::string& name) {
  for (const Finding& finding : findings) {
    if (finding.what.rfind(name + ":", 0) == 0 || finding.what.rfind(name + " ", 0) == 0) return finding;
  }
  ADD_FAILURE() << "no line about " << name;
  return {};
}

StampStatistics stamps(int count, double period_s, const std::function<int64_t(int)>& change) {
  StampStatistics statistics;
  for (int i = 0; i < count; ++i) {
    const int64_t moved = change(i);
    if (moved != INT64_MIN) statistics.note(static_cast<int64_t>(1e6 * period_s * i) + moved, 100);
  }
  return statistics;
}

TEST(StampStatistics, HaveRateJitterAndHoles) {
  const auto even = stamps(100, 0.02, [](int) { return 0; }).summary();
  EXPECT_NEAR(even.rate_hz, 50, 1e-6);
  EXPECT_EQ(even.jitter_s, 0);
  EXPECT_EQ(even.holes, 0);
  const auto holes = stamps(100, 0.02, [](int i) { return i % 10 == 5 ? INT64_MIN : 0; }).summary();
  EXPECT_EQ(holes.holes, 10);
  EXPECT_NEAR(holes.longest_gap_s, 0.04, 1e-9);
  EXPECT_EQ(holes.jitter_s, 0);
  const auto jitter = stamps(101, 0.02, [](int i) { return i % 2 == 0 ? 0 : 2000; }).summary();
  EXPECT_NEAR(jitter.jitter_s, 0.0028, 0.0002) << "steps of 18 and 22 ms about one of them";
  EXPECT_EQ(stamps(100, 0.02, [](int i) { return i == 50 ? -100'000 : 0; }).summary().backwards, 1);
}

TEST(FindStream, FailsByTheConfigurationsOwnFigures) {
  Configuration configuration;
  configuration.capture.rate_hz = 50;
  const auto even = stamps(100, 0.02, [](int) { return 0; });
  EXPECT_TRUE(findStream("CAMERA", even, 0, cameraLimits(configuration)).good);
  EXPECT_FALSE(findStream("CAMERA", even, 1, cameraLimits(configuration)).good) << "damaged";
  configuration.capture.rate_hz = 100;
  const Finding slow = findStream("CAMERA", even, 0, cameraLimits(configuration));
  EXPECT_FALSE(slow.good);
  EXPECT_NE(slow.what.find("capture.rate_hz is 100"), std::string::npos) << slow.what;
  const auto gap = stamps(100, 0.005, [](int i) { return i < 50 ? 0 : 150'000; });
  const Finding gaping = findStream("IMU", gap, 0, imuLimits(configuration));
  EXPECT_FALSE(gaping.good);
  EXPECT_NE(gaping.what.find("inertial.max_imu_gap_s is 100 ms"), std::string::npos) << gaping.what;
  EXPECT_FALSE(findStream("IMU", {}, 0, imuLimits(configuration)).good) << "silent";
}

/// `noise` times the configured densities.
RestReport restOf(double noise, double turning_rad_s, double duration_s = 5) {
  const ImuNoise expected;
  constexpr double kRate_hz = 200;
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  const auto draw = [&](double density) {
    const double sigma = noise * density * std::sqrt(kRate_hz);
    return Eigen::Vector3d(sigma * normal(random), sigma * normal(random), sigma * normal(random));
  };
  std::vector<ImuSample> samples;
  for (int i = 0; i < duration_s * kRate_hz; ++i) {
    const double t = i / kRate_hz;
    const Eigen::Vector3d turn = turning_rad_s * std::sin(3 * t) * Eigen::Vector3d::UnitY();
    samples.push_back({ImuTime(fromSeconds(t)),
                       Eigen::Vector3d(0.01, 0, 0) + turn + draw(expected.gyro_noise_density),
                       Eigen::Vector3d(0, 0, 9.81) + draw(expected.accel_noise_density)});
  }
  return restNoise(samples, expected);
}

TEST(RestNoise, IsTheDensityAndOnlyAtRest) {
  const ImuNoise expected;
  for (const double factor : {0.5, 1.0, 5.0}) {
    const RestReport report = restOf(factor, 0);
    ASSERT_TRUE(report.noise.has_value()) << factor;
    EXPECT_NEAR(report.noise->gyro_density / expected.gyro_noise_density, factor, 0.3 * factor);
    EXPECT_NEAR(report.noise->accel_density / expected.accel_noise_density, factor, 0.3 * factor);
    EXPECT_EQ(findImuNoise(report, {}).good, factor < 2) << findImuNoise(report, {}).what;
  }
  const Finding moving = findImuNoise(restOf(1, 0.1), {});
  EXPECT_FALSE(moving.checked);
  EXPECT_NE(moving.what.find("the vehicle moves"), std::string::npos);
  EXPECT_FALSE(findImuNoise(restOf(1, 0, 1), {}).checked) << "a second is too short";
}

ImageQuality qualityOf(const cv::Mat1b& image) {
  ImageQuality quality;
  quality.note(rawGreyMessage(1, image));
  return quality;
}

TEST(FindExposure, SaysDarkBrightAndBlurred) {
  cv::Mat1b noise(240, 320);
  cv::RNG random(1);
  random.fill(noise, cv::RNG::UNIFORM, 60, 180);
  cv::Mat1b texture;
  cv::GaussianBlur(noise, texture, {}, 2);
  cv::normalize(texture, texture, 40, 200, cv::NORM_MINMAX);
  const Configuration configuration;
  EXPECT_TRUE(findExposure(qualityOf(texture), configuration).good)
      << findExposure(qualityOf(texture), configuration).what;
  EXPECT_TRUE(findSharpness(qualityOf(texture), configuration).good)
      << findSharpness(qualityOf(texture), configuration).what;
  const Finding dark = findExposure(qualityOf(texture * 0.1), configuration);
  EXPECT_NE(dark.what.find("too dark"), std::string::npos) << dark.what;
  cv::Mat1b sky = texture.clone();
  sky.rowRange(0, 24) = 255;
  const Finding bright = findExposure(qualityOf(sky), configuration);
  EXPECT_NE(bright.what.find("10.0 % saturated"), std::string::npos) << bright.what;
  EXPECT_FALSE(bright.good);
  EXPECT_FALSE(findExposure(qualityOf(cv::Mat1b(240, 320, uint8_t{128})), configuration).good) << "covered";
  cv::Mat1b blurred;
  cv::GaussianBlur(texture, blurred, {}, 12);
  EXPECT_FALSE(findSharpness(qualityOf(blurred), configuration).good);
}

TEST(FindDisk, KeepsWhatTheRecorderKeeps) {
  const ScratchFolder folder;
  const Finding here = findDisk(folder / "not" / "there", 1e6);
  EXPECT_NE(here.what.find("MB free"), std::string::npos) << here.what;
}

/// The check beside a whole stack on a simulated flight.
std::vector<Finding> checkFlight(double apart_s) {
  StackFlight flight = faultFlight(216);
  flight.configuration.inertial.extrinsics.timeshift_s += apart_s;
  const auto bus = makeLcmBus("memq://");
  LiveCheck check(*bus, flight.configuration);
  EXPECT_FALSE(check.hasHeard());
  StackRun(flight, *bus).run();
  EXPECT_TRUE(check.hasHeard());
  return check.findings();
}

TEST(LiveCheck, PassesAFlightAndFailsWhereStampsAreApart) {
  const std::vector<Finding> good = checkFlight(0);
  for (const char* name : {"CAMERA", "IMU", "ALTIMETER", "exposure", "sharpness", "time shift"}) {
    EXPECT_TRUE(lineOf(good, name).good) << lineOf(good, name).what;
    EXPECT_TRUE(lineOf(good, name).checked) << lineOf(good, name).what;
  }
  EXPECT_FALSE(lineOf(good, "IMU noise").checked) << "it flies";
  const Finding apart = lineOf(checkFlight(0.03), "time shift");
  EXPECT_FALSE(apart.good) << apart.what;
  EXPECT_NE(apart.fix.find("camera.timeshift_s"), std::string::npos) << apart.fix;
}

}  // namespace
}  // namespace redbee::test
