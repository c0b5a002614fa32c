#include "redbee/importers/import_gopro.hpp"

#include <cctype>
#include <cmath>
#include <sstream>

#include "redbee/image_t.hpp"
#include "redbee/importers/data_track.hpp"
#include "redbee/importers/gopro_imu.hpp"
#include "redbee/importers/importer.hpp"
#include "redbee/ins_t.hpp"
#include "redbee/results/video_writer.hpp"
#include "tests/support/log_events.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/shared_flight.hpp"

namespace redbee::test {
namespace {

TEST(ImportGoproTest, AVideoWithoutMetadataIsRefused) {
  const ScratchFolder folder;
  ImportOptions options;
  options.source = folder / "v.mp4";
  options.log = folder / "v.lcm";
  VideoWriter writer(options.source, {64, 64}, 25);
  for (int k = 0; k < 5; ++k) writer.write(texture(64, 64, k, 3));
  writer.close();
  Progress progress("importing", "frames", true);
  EXPECT_NE(
      errorMessageOf([&] { goproImporter().import(options, progress); }).find("v.mp4: has no GPMF track"),
      std::string::npos);
  EXPECT_FALSE(fs::exists(options.log));
}

/// The columns of a CSV file of numbers; lines that do not start with a number are passed over.
std::vector<std::vector<double>> readNumbers(const fs::path& file) {
  std::vector<std::vector<double>> rows;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || (std::isdigit(static_cast<unsigned char>(line[0])) == 0 && line[0] != '-')) continue;
    std::vector<double> row;
    std::stringstream fields(line);
    for (std::string field; std::getline(fields, field, ',');) row.push_back(std::stod(field));
    rows.push_back(row);
  }
  return rows;
}

TEST(ImportGoproTest, AKarmaFlight) {
  const auto flight = sharedFlight("karma");
  if (!flight) GTEST_SKIP() << "the recorded flights are not here (REDBEE_SHARED)";
  const ScratchFolder folder;
  ImportOptions options;
  options.source = *flight / "karma.mp4";
  options.log = folder / "karma.lcm";
  Progress progress("importing", "frames", true);
  const ImportSummary summary = importRecording(goproImporter(), options, progress);
  std::cout << summary.frames << " frames, gyro " << summary.imu_rate_hz << " Hz, " << summary.imu_samples
            << " samples\n";
  EXPECT_EQ(summary.frames, 362);
  EXPECT_NEAR(summary.imu_rate_hz, 397, 1);
  EXPECT_EQ(summary.vehicle.width, 854);
  EXPECT_EQ(summary.vehicle.height, 480);

  const auto events = readEvents(options.log);
  EXPECT_TRUE(isSortedByTime(events));
  const auto frame_times = readNumbers(*flight / "frame_times.csv");
  const auto frames = messagesOn<image_t>(events, "CAMERA");
  ASSERT_EQ(frames.size(), frame_times.size());
  for (size_t k = 0; k < frames.size(); ++k)
    ASSERT_NEAR(seconds(fromUtime(frames[k].utime)), frame_times[k][1], 2e-6);

  const auto reference = readNumbers(*flight / "imu.csv");
  const auto imu = messagesOn<ins_t>(events, "IMU");
  ASSERT_EQ(imu.size(), reference.size());
  double time_error = 0;
  double gyro_error = 0;
  double accel_error = 0;
  for (size_t k = 0; k < imu.size(); ++k) {
    const auto& row = reference[k];
    time_error = std::max(time_error, std::abs(seconds(fromUtime(imu[k].utime)) - row[0]));
    // The reference lists (Z, X, Y); I = (-Y, X, Z).
    const Eigen::Vector3d gyro(-row[3], row[2], row[1]);
    const Eigen::Vector3d accel(-row[6], row[5], row[4]);
    gyro_error = std::max(gyro_error, (Eigen::Map<const Eigen::Vector3d>(imu[k].gyro) - gyro).norm());
    accel_error = std::max(accel_error, (Eigen::Map<const Eigen::Vector3d>(imu[k].accel) - accel).norm());
  }
  std::cout << "largest difference to imu.csv: " << 1e6 * time_error << " us, " << gyro_error << " rad/s, "
            << accel_error << " m/s^2\n";
  EXPECT_LT(time_error, 2e-6);
  EXPECT_LT(gyro_error, 1e-5);
  EXPECT_LT(accel_error, 0.05);
}

/// Checks the signs of the axes by the autopilot's velocity: forward acceleration is positive along x.
TEST(ImportGoproTest, KarmaAccelerometerAgreesWithTheVelocityOfTheDrone) {
  const auto flight = sharedFlight("karma");
  if (!flight) GTEST_SKIP() << "the recorded flights are not here (REDBEE_SHARED)";
  const auto imu = mergeAtGyroTimes(readGoproStreams(readDataTrack(*flight / "karma.mp4", "gpmd")));
  const auto velocity = readNumbers(*flight / "drone_lned.csv");
  const auto attitude = readNumbers(*flight / "drone_attd.csv");
  double xy = 0, xx = 0, yy = 0, mean_x = 0, mean_y = 0;
  std::vector<std::pair<double, double>> pairs;
  for (size_t k = 1; k + 1 < velocity.size(); ++k) {
    const double dt = velocity[k + 1][0] - velocity[k - 1][0];
    const double north = (velocity[k + 1][5] - velocity[k - 1][5]) / dt;
    const double east = (velocity[k + 1][6] - velocity[k - 1][6]) / dt;
    const double heading = attitude[k][4];
    double felt = 0;
    int count = 0;
    for (const ImuSample& sample : imu) {
      if (std::abs(seconds(sample.time.time_since_epoch()) - velocity[k][0]) > 0.25) continue;
      felt += sample.accel.x();
      ++count;
    }
    if (count > 0) pairs.emplace_back(north * std::cos(heading) + east * std::sin(heading), felt / count);
  }
  for (const auto& [x, y] : pairs) {
    mean_x += x / static_cast<double>(pairs.size());
    mean_y += y / static_cast<double>(pairs.size());
  }
  for (const auto& [x, y] : pairs) {
    xy += (x - mean_x) * (y - mean_y);
    xx += (x - mean_x) * (x - mean_x);
    yy += (y - mean_y) * (y - mean_y);
  }
  const double correlation = xy / std::sqrt(xx * yy);
  std::cout << "forward specific force against forward acceleration: correlation " << correlation
            << ", slope " << xy / xx << "\n";
  EXPECT_GT(correlation, 0.9);
}

}  // namespace
}  // namespace redbee::test
