#include "redbee/importers/gpmf.hpp"

#include <cctype>
#include <cmath>
#include <cstring>
#include <random>
#include <sstream>

#include "redbee/image_t.hpp"
#include "redbee/importers/gopro_imu.hpp"
#include "redbee/importers/import_gopro.hpp"
#include "redbee/ins_t.hpp"
#include "redbee/results/video_writer.hpp"
#include "tests/support/scratch.hpp"

namespace redbee {
namespace {

using namespace testing;  // NOLINT: the test's own helpers

using Bytes = std::vector<uint8_t>;

void append(Bytes& to, const Bytes& what) { to.insert(to.end(), what.begin(), what.end()); }

Bytes bigEndian(uint64_t value, int bytes) {
  Bytes out;
  for (int shift = 8 * bytes - 8; shift >= 0; shift -= 8) out.push_back(static_cast<uint8_t>(value >> shift));
  return out;
}

Bytes record(const std::string& key, char type, size_t sample_size, size_t count, Bytes data) {
  Bytes out(key.begin(), key.end());
  out.push_back(static_cast<uint8_t>(type));
  out.push_back(static_cast<uint8_t>(sample_size));
  append(out, bigEndian(count, 2));
  while (data.size() % 4 != 0) data.push_back(0);
  append(out, data);
  return out;
}

Bytes container(const std::string& key, const Bytes& inside) {
  return record(key, 0, 1, inside.size(), inside);
}
Bytes text(const std::string& key, const std::string& words) {
  return record(key, 'c', words.size(), 1, Bytes(words.begin(), words.end()));
}
Bytes shorts(const std::vector<int>& values) {
  Bytes out;
  for (const int value : values) append(out, bigEndian(static_cast<uint16_t>(value), 2));
  return out;
}

/// One sensor's stream: `total` samples after this payload, `count` of them in it, all with the same reading.
Bytes stream(const std::string& key, const std::string& unit, int scale, int total, int count,
             const std::vector<int>& reading, const Bytes& extra = {}) {
  std::vector<int> values;
  for (int k = 0; k < count; ++k) values.insert(values.end(), reading.begin(), reading.end());
  Bytes inside = record("TSMP", 'L', 4, 1, bigEndian(static_cast<uint64_t>(total), 4));
  append(inside, text("SIUN", unit));
  append(inside, record("SCAL", 's', 2, 1, shorts({scale})));
  append(inside, extra);
  append(inside, record(key, 's', 6, static_cast<size_t>(count), shorts(values)));
  return container("STRM", inside);
}

Bytes payload(int index, int gyro_count, const std::string& gyro_unit = "rad/s",
              const Bytes& gyro_extra = {}) {
  Bytes inside =
      stream("ACCL", "m/s\xB2", 100, (index + 1) * gyro_count / 2, gyro_count / 2, {981, 100, -200});
  append(inside, stream("GYRO", gyro_unit, 1000, (index + 1) * gyro_count, gyro_count, {1000, 2000, 3000},
                        gyro_extra));
  return container("DEVC", inside);
}

std::vector<DataPacket> packets(int count, const std::string& unit = "rad/s", const Bytes& extra = {}) {
  std::vector<DataPacket> out;
  out.reserve(static_cast<size_t>(count));
  for (int k = 0; k < count; ++k) out.push_back({1.0 * k, 1.0, payload(k, 400, unit, extra)});
  return out;
}

TEST(GpmfTest, SamplesAreScaled) {
  const auto found = gpmfSensor(payload(0, 4), "GYRO");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].unit, "rad/s");
  EXPECT_EQ(found[0].total_after, 4);
  ASSERT_EQ(found[0].values.size(), 4u);
  EXPECT_EQ(found[0].values[3], (std::array<double, 3>{1, 2, 3}));
}

TEST(GpmfTest, OrinAndOrioTurnTheAxes) {
  Bytes extra = text("ORIN", "YxZ");
  append(extra, text("ORIO", "ZXY"));
  const auto found = gpmfSensor(payload(0, 4, "rad/s", extra), "GYRO");
  ASSERT_EQ(found.size(), 1u);
  // Stored as (Y, -X, Z) = (1, 2, 3): Z = 3, X = -2, Y = 1.
  EXPECT_EQ(found[0].values[0], (std::array<double, 3>{3, -2, 1}));
  EXPECT_EQ(found[0].axes, "ZXY");
}

TEST(GpmfTest, AMatrixTurnsTheAxesWhereThereAreNoNames) {
  Bytes numbers;
  for (const float value : {0.f, 0.f, 1.f, 0.f, -1.f, 0.f, 1.f, 0.f, 0.f}) {
    uint32_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    append(numbers, bigEndian(bits, 4));
  }
  const auto found = gpmfSensor(payload(0, 4, "rad/s", record("MTRX", 'f', 4, 9, numbers)), "GYRO");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].values[0], (std::array<double, 3>{3, -2, 1}));
}

TEST(GpmfTest, EveryTruncationIsAnErrorOrShorter) {
  const Bytes whole = payload(0, 8);
  for (size_t size = 0; size < whole.size(); ++size) {
    const Bytes cut(whole.begin(), whole.begin() + static_cast<long>(size));
    try {
      EXPECT_TRUE(gpmfSensor(cut, "GYRO").empty()) << size;
    } catch (const GpmfError&) {
    }
  }
}

TEST(GpmfTest, RandomDamageNeverReadsOutside) {
  const Bytes whole = payload(0, 8);
  std::mt19937 random(7);
  int refused = 0;
  for (int round = 0; round < 5000; ++round) {
    Bytes damaged = whole;
    for (int hit = 0; hit < 3; ++hit) damaged[random() % damaged.size()] = static_cast<uint8_t>(random());
    damaged.shrink_to_fit();
    try {
      for (const GpmfSamples& samples : gpmfSensor(damaged, "GYRO"))
        EXPECT_LE(samples.values.size(), damaged.size());
    } catch (const GpmfError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 0);
}

TEST(GpmfTest, DeepNestingIsRefused) {
  Bytes nested = text("STNM", "x");
  for (int depth = 0; depth < 2 * kMaxGpmfDepth; ++depth) nested = container("DEVC", nested);
  EXPECT_THROW(gpmfSensor(nested, "GYRO"), GpmfError);
}

TEST(GoproImuTest, SamplesLieOnOneClockInTheImuFrame) {
  const GoproStreams streams = readGoproStreams(packets(5));
  ASSERT_EQ(streams.gyro.size(), 2000u);
  ASSERT_EQ(streams.accel.size(), 1000u);
  for (size_t k = 0; k < streams.gyro.size(); ++k)
    ASSERT_NEAR(streams.gyro[k].t_s, static_cast<double>(k) / 400, 1e-9);
  // Stored (Z, X, Y) = (1, 2, 3): I = (-Y, X, Z).
  EXPECT_LT((streams.gyro[7].value - Eigen::Vector3d(-3, 2, 1)).norm(), 1e-12);
  EXPECT_LT((streams.accel[7].value - Eigen::Vector3d(2, 1, 9.81)).norm(), 1e-12);
  EXPECT_EQ(mergeAtGyroTimes(streams).size(), 2000u);
}

TEST(GoproImuTest, ALostPayloadLeavesAHoleAndNoShift) {
  auto some = packets(5);
  some.erase(some.begin() + 2);
  const GoproStreams streams = readGoproStreams(some);
  ASSERT_EQ(streams.gyro.size(), 1600u);
  EXPECT_NEAR(streams.gyro[800].t_s, 3.0, 1e-9);
}

TEST(GoproImuTest, OnePayloadIsSpreadOverItsDuration) {
  const GoproStreams streams = readGoproStreams(packets(1));
  EXPECT_NEAR(streams.gyro[399].t_s, 399.0 / 400, 1e-9);
}

TEST(GoproImuTest, TheAccelerometerIsInterpolated) {
  GoproStreams streams;
  streams.gyro = {{0.5, {0, 0, 0}}, {1.25, {0, 0, 0}}, {3, {0, 0, 0}}};
  streams.accel = {{1, {0, 0, 4}}, {2, {0, 0, 8}}};
  const auto merged = mergeAtGyroTimes(streams);
  EXPECT_EQ(merged[0].accel.z(), 4);
  EXPECT_NEAR(merged[1].accel.z(), 5, 1e-12);
  EXPECT_EQ(merged[2].accel.z(), 8);
  EXPECT_EQ(merged[1].utime, 1'250'000);
}

TEST(GoproImuTest, UnitsAreChecked) {
  EXPECT_NEAR(readGoproStreams(packets(2, "deg/s")).gyro[0].value.z(), M_PI / 180, 1e-12);
  EXPECT_THROW(readGoproStreams(packets(2, "furlong")), GpmfError);
}

TEST(ImportGoproTest, AVideoWithoutMetadataIsRefused) {
  const ScratchFolder folder;
  GoproImportOptions options;
  options.video = folder / "v.mp4";
  options.log = folder / "v.lcm";
  VideoWriter writer(options.video, {64, 64}, 25);
  for (int k = 0; k < 5; ++k) writer.write(texture(64, 64, k, 3));
  writer.close();
  Progress progress("importing", "frames", true);
  EXPECT_NE(complaintOf([&] { importGopro(options, progress); }).find("v.mp4: has no GPMF track"),
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
  const auto flight = recordedFlight("karma");
  if (!flight) GTEST_SKIP() << "the recorded flights are not here (REDBEE_SHARED)";
  const ScratchFolder folder;
  GoproImportOptions options;
  options.video = *flight / "karma.mp4";
  options.log = folder / "karma.lcm";
  Progress progress("importing", "frames", true);
  const ImportSummary summary = importGopro(options, progress);
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
    ASSERT_NEAR(1e-6 * static_cast<double>(frames[k].utime), frame_times[k][1], 2e-6);

  const auto reference = readNumbers(*flight / "imu.csv");
  const auto imu = messagesOn<ins_t>(events, "IMU");
  ASSERT_EQ(imu.size(), reference.size());
  double time_error = 0;
  double gyro_error = 0;
  double accel_error = 0;
  for (size_t k = 0; k < imu.size(); ++k) {
    const auto& row = reference[k];
    time_error = std::max(time_error, std::abs(1e-6 * static_cast<double>(imu[k].utime) - row[0]));
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

/// The axes' signs against the autopilot's own velocity: whoever accelerates forward feels it forward.
TEST(ImportGoproTest, KarmaAccelerometerAgreesWithTheVelocityOfTheDrone) {
  const auto flight = recordedFlight("karma");
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
      if (std::abs(1e-6 * static_cast<double>(sample.utime) - velocity[k][0]) > 0.25) continue;
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
}  // namespace redbee
