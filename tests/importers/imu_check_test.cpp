// Tables in wrong units, on wrong clocks, of dead sensors.
#include "redbee/importers/imu_check.hpp"

#include <gtest/gtest.h>

#include "tests/support/synthetic_imu.hpp"

namespace redbee::test {
namespace {

using Change = std::function<void(ImuSample&)>;

/// What the check says of a swing of four seconds over a video of the same length.
ImuFindings findingsOf(const Change& change, double rate_hz = 200) {
  std::vector<ImuSample> imu = swingingImu(rate_hz, 4);
  for (ImuSample& sample : imu) change(sample);
  return checkImu(imu, CameraTime(Duration(0)), CameraTime(fromSeconds(3.95)));
}

Change timesScaled(double factor) {
  return [factor](ImuSample& sample) {
    sample.time = ImuTime(fromSeconds(factor * seconds(sample.time.time_since_epoch())));
  };
}

testing::AssertionResult says(const std::vector<std::string>& lines, const std::string& text) {
  std::string all;
  for (const std::string& line : lines) {
    if (line.find(text) != std::string::npos) return testing::AssertionSuccess();
    all += "\n" + line;
  }
  return testing::AssertionFailure() << "'" << text << "' is in none of:" << all;
}

TEST(ImuCheckTest, AGoodRecordingIsNotCommented) {
  for (const double rate_hz : {100.0, 200.0, 1000.0}) {
    const ImuFindings findings = findingsOf([](ImuSample&) {}, rate_hz);
    EXPECT_TRUE(findings.faults.empty()) << findings.faults[0];
    EXPECT_TRUE(findings.warnings.empty()) << findings.warnings[0];
  }
}

TEST(ImuCheckTest, TheUnitThatFitsIsNamed) {
  EXPECT_TRUE(says(findingsOf([](ImuSample& s) { s.gyro *= 180 / M_PI; }).faults, "give --gyro-unit deg/s"));
  EXPECT_TRUE(says(findingsOf([](ImuSample& s) { s.accel /= 9.80665; }).faults, "give --accel-unit g"));
  EXPECT_TRUE(
      says(findingsOf([](ImuSample& s) { s.accel *= 1000 / 9.80665; }).faults, "give --accel-unit mg"));
  EXPECT_TRUE(says(findingsOf(timesScaled(1e3)).faults, "give --time-unit ms"));
  EXPECT_TRUE(says(findingsOf(timesScaled(1e6)).faults, "give --time-unit us"));
}

TEST(ImuCheckTest, AnAccelerometerWithoutGravityIsAFault) {
  const auto findings = findingsOf([](ImuSample& s) { s.accel *= 0.02; });
  EXPECT_TRUE(says(findings.faults, "linear acceleration"));
  EXPECT_TRUE(says(findingsOf([](ImuSample& s) { s.accel.setZero(); }).faults, "median length is 0"));
}

/// In the sensor's frame, where a hand shakes it five times a second, in circles.
Eigen::Vector3d shakingAt(const ImuSample& sample) {
  const double angle = 2 * M_PI * 5 * seconds(sample.time.time_since_epoch());
  return 14 * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0);
}

void shake(ImuSample& sample) { sample.accel += shakingAt(sample); }

/// A phone in the hand of somebody who runs was refused.
TEST(ImuCheckTest, AShakenSensorHasGravityInItsMean) {
  const ImuFindings findings = findingsOf(shake);
  EXPECT_TRUE(findings.faults.empty()) << findings.faults[0];
  EXPECT_TRUE(says(findings.warnings, "shaken hard (gravity is in its mean, 9."));
}

TEST(ImuCheckTest, ShakingHidesNoWrongUnit) {
  const auto faultsOf = [](const Change& change) {
    return findingsOf([&](ImuSample& sample) {
             shake(sample);
             change(sample);
           })
        .faults;
  };
  EXPECT_TRUE(says(faultsOf([](ImuSample& s) { s.accel /= 9.80665; }), "give --accel-unit g"));
  EXPECT_TRUE(says(faultsOf([](ImuSample& s) { s.accel *= 1000 / 9.80665; }), "give --accel-unit mg"));
  EXPECT_TRUE(says(faultsOf([](ImuSample& s) { s.gyro *= 180 / M_PI; }), "give --gyro-unit deg/s"));
  EXPECT_TRUE(says(faultsOf([](ImuSample& s) { s.accel *= 16384 / 9.80665; }), "in no known unit"));
  EXPECT_TRUE(says(faultsOf([](ImuSample& s) { s.accel = 1.2 * shakingAt(s); }), "linear acceleration"));
}

/// Neither does vibration that leaves the accelerometer's median as it is, at no whole part of what is
/// compared.
TEST(ImuCheckTest, VibrationHidesNoWrongUnitOfTheGyro) {
  const auto shaken = [](double gyro_factor) {
    return findingsOf([&](ImuSample& sample) {
      const double angle = 2 * M_PI * 3.3 * seconds(sample.time.time_since_epoch());
      sample.accel += 2 * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0);
      sample.gyro *= gyro_factor;
    });
  };
  EXPECT_TRUE(shaken(1).faults.empty());
  EXPECT_TRUE(says(shaken(180 / M_PI).faults, "give --gyro-unit deg/s"));
}

/// As of a logger whose driver reads the gyro's registers wrongly.
TEST(ImuCheckTest, AGyroThatContradictsGravityInEveryUnitIsAWarning) {
  EXPECT_TRUE(says(findingsOf([](ImuSample& s) { s.gyro = {17, 0, 17}; }).warnings, "the gyro is broken"));
  EXPECT_TRUE(says(findingsOf([](ImuSample& s) { s.gyro = 12 * s.gyro.reverse().eval(); }).warnings,
                   "signs or axes of one of them are wrong"));
}

TEST(ImuCheckTest, AHandfulOfSamplesIsAWarning) {
  std::vector<ImuSample> imu = swingingImu(200, 4);
  imu.resize(9);
  const CameraTime first(Duration(0)), last(fromSeconds(3.95));
  EXPECT_TRUE(says(checkImu(imu, first, last).warnings, "the IMU has 9 samples"));
  imu.resize(1);
  EXPECT_TRUE(says(checkImu(imu, first, last).warnings, "the IMU has 1 sample,"));
}

TEST(ImuCheckTest, ATimeThatLeapsIsAFault) {
  int number = 0;
  const auto findings = findingsOf([&](ImuSample& s) {
    if (++number > 790) s.time += std::chrono::hours(24 * 365);
  });
  EXPECT_TRUE(says(findings.faults, "the IMU's times leap by 31536000"));
}

TEST(ImuCheckTest, AnotherClockIsAFault) {
  const auto findings = findingsOf([](ImuSample& s) { s.time += std::chrono::seconds(1'600'000'000); });
  EXPECT_TRUE(says(findings.faults, "covers none of the frames"));
}

TEST(ImuCheckTest, DeadSensorsSlowOnesAndHolesAreToldWithTheirFix) {
  EXPECT_TRUE(says(findingsOf([](ImuSample& s) { s.gyro.setZero(); }).warnings, "gx = 0, gy = 0, gz = 0"));
  EXPECT_TRUE(says(findingsOf([](ImuSample& s) { s.accel.y() = 0.5; }).warnings, "ay = 0.5"));
  EXPECT_TRUE(says(findingsOf([](ImuSample&) {}, 5).warnings, "5 Hz"));
  EXPECT_TRUE(says(findingsOf([](ImuSample&) {}, 50).warnings, "50 Hz, which is slow"));
  std::vector<ImuSample> imu = swingingImu(200, 4);
  imu.erase(imu.begin() + 200, imu.begin() + 300);
  const auto findings = checkImu(imu, CameraTime(Duration(0)), CameraTime(fromSeconds(3.95)));
  EXPECT_TRUE(says(findings.warnings, "1 hole, the longest of 0.505 s at 0.995 s"));
  EXPECT_TRUE(findings.faults.empty());
}

}  // namespace
}  // namespace redbee::test
