// IMU recordings of phones and loggers, as their documentation has them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "redbee/importers/imu_table.hpp"
#include "tests/support/log_events.hpp"
#include "tests/support/scratch_folder.hpp"

namespace redbee::test {

inline constexpr int64_t kStart_ns = 1'700'000'000'000'000'000;
inline constexpr int kSamples = 300;
inline constexpr int64_t kPeriod_ns = 5'000'000;

// At the time t [s]: about z alone, and gravity along y.
inline double rateAt(double t) { return 0.3 * std::sin(4 * t); }
inline double forceAt(double t) { return 9.81 + 0.2 * std::cos(3 * t); }

/// Rows of `format`, whose N is the time [ns], and G or A the value; times begin at `start_ns`.
inline std::string rows(const std::string& format, int64_t start_ns, int64_t offset_ns, double sign = 1) {
  std::string text;
  for (int k = 0; k < kSamples; ++k) {
    const int64_t since = k * kPeriod_ns + offset_ns;
    const double t = 1e-9 * static_cast<double>(since);
    for (const char c : format) {
      switch (c) {
        case 'N':
          text += std::to_string(start_ns + since);
          break;
        case 'S':
          text += std::to_string(t);
          break;
        case 'G':
          text += std::to_string(sign * rateAt(t));
          break;
        case 'A':
          text += std::to_string(sign * forceAt(t));
          break;
        default:
          text += c;
      }
    }
    text += "\n";
  }
  return text;
}

class ImuTableTest : public testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) const { writeText(folder_ / name, text); }
  ImuTable read(const std::string& name, const std::string& video = "video.mp4") const {
    return readImuTable(folder_ / name, folder_ / video, {});
  }
  void expectError(const std::string& name, const std::string& part) const {
    const std::string line = errorMessageOf([&] { read(name); });
    EXPECT_NE(line.find(part), std::string::npos) << line;
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
  }
  /// Samples lie on rateAt() about z and forceAt() along y, at the video's time plus `shift_s`.
  static void expectMotion(const ImuTable& table, double shift_s, size_t at_least = kSamples - 2) {
    ASSERT_GE(table.samples.size(), at_least);
    for (const ImuSample& sample : table.samples) {
      const double t = seconds(sample.time.time_since_epoch()) + shift_s;
      EXPECT_LT((sample.gyro - Eigen::Vector3d(0, 0, rateAt(t))).norm(), 1e-4) << t;
      EXPECT_LT((sample.accel - Eigen::Vector3d(0, forceAt(t), 0)).norm(), 1e-3) << t;
    }
  }
  static bool warns(const ImuTable& table, const std::string& part) {
    return std::any_of(table.warnings.begin(), table.warnings.end(),
                       [&](const std::string& line) { return line.find(part) != std::string::npos; });
  }
  void writeSensorLogger(const std::string& platform, double sign) const {
    const std::string header = "time,seconds_elapsed,z,y,x\n";
    write("Gyroscope.csv", header + rows("N,S,G,0,0", kStart_ns, 1'000'000));
    write("TotalAcceleration.csv", header + rows("N,S,0,A,0", kStart_ns, 3'000'000, sign));
    write("Metadata.csv",
          "version,device name,recording epoch time,platform,standardisation\n3,phone,1," + platform + "\n");
  }
  ScratchFolder folder_;
};

}  // namespace redbee::test
