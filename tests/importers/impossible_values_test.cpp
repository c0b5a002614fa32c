// Values that no sensor measures, as a damaged chunk of a recording holds them, in each importer's
// recordings.
#include "redbee/importers/impossible_values.hpp"

#include <cstring>
#include <limits>

#include "redbee/altimeter_t.hpp"
#include "redbee/importers/import_gopro.hpp"
#include "redbee/importers/import_video.hpp"
#include "redbee/importers/imu_check.hpp"
#include "redbee/importers/mcap/import_mcap.hpp"
#include "redbee/ins_t.hpp"
#include "tests/support/asl_folder.hpp"
#include "tests/support/gpmf_bytes.hpp"
#include "tests/support/mcap_recording.hpp"
#include "tests/support/synthetic_imu.hpp"
#include "tests/support/test_video.hpp"

namespace redbee::test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(ImpossibleValues, AreLeftOutAndSaid) {
  const std::vector<ImuSample> good = swingingImu(200, 4);
  std::vector<ImuSample> imu = good;
  imu[100].gyro.y() = 1e30;
  imu[200].gyro.x() = kNan;
  imu[300].accel.z() = -1e9;
  EXPECT_EQ(leaveOutImpossible(imu).rfind("3 of 800 IMU samples are beyond what any measures", 0), 0u);
  ASSERT_EQ(imu.size(), 797u);
  for (const ImuSample& sample : imu) EXPECT_TRUE(isPossible(sample));
  EXPECT_EQ(imu[99].time, good[99].time);
  EXPECT_EQ(imu[100].time, good[101].time);
  EXPECT_EQ(leaveOutImpossible(imu), "");
}

TEST(ImpossibleValues, ManyAreAnotherUnitOrNoSensors) {
  std::vector<ImuSample> imu = swingingImu(200, 4);
  for (ImuSample& sample : imu) sample.gyro *= 1e4;  // raw counts, say
  EXPECT_EQ(leaveOutImpossible(imu), "");
  EXPECT_EQ(imu.size(), 800u);
  const ImuFindings findings = checkImu(imu, CameraTime(Duration(0)), CameraTime(fromSeconds(3.95)));
  ASSERT_EQ(findings.faults.size(), 1u);
  EXPECT_NE(findings.faults[0].find("IMU samples are beyond what any measures"), std::string::npos);
}

TEST(ImpossibleValues, SeveralInAMisreadUnitDoNotHideIt) {
  std::vector<ImuSample> imu = swingingImu(200, 4);
  for (ImuSample& sample : imu) sample.gyro *= 180 / M_PI;
  imu[100].gyro.x() = 300;
  imu[300].accel.x() = 1e9;
  EXPECT_NE(leaveOutImpossible(imu), "");
  const ImuFindings findings = checkImu(imu, CameraTime(Duration(0)), CameraTime(fromSeconds(3.95)));
  ASSERT_FALSE(findings.faults.empty());
  EXPECT_NE(findings.faults[0].find("--gyro-unit deg/s"), std::string::npos);
}

class ImpossibleRecording : public AslFolder {
 protected:
  /// Imports and demands that what is impossible was said, is not in the log, and that the rest is.
  void expectLeftOut(const Importer& importer, const fs::path& source, size_t good_samples,
                     const fs::path& imu = {}) {
    ImportOptions options = importer.defaults;
    options.source = source;
    options.log = log();
    if (!imu.empty()) options.imu = imu;
    Progress progress("importing", "frames", true);
    const ImportSummary summary = importRecording(importer, options, progress);
    const auto says = [](const std::string& line) {
      return line.find("are beyond what any") != std::string::npos;
    };
    EXPECT_EQ(std::count_if(summary.warnings.begin(), summary.warnings.end(), says), 1) << source;
    const auto messages = messagesOn<ins_t>(readEvents(log()), "IMU");
    EXPECT_EQ(messages.size(), good_samples) << source;
    for (const ins_t& message : messages) {
      for (int axis = 0; axis < 3; ++axis) {
        ASSERT_LT(std::abs(message.gyro[axis]), 10) << source << " at " << message.utime;
        ASSERT_LT(std::abs(message.accel[axis]), 100) << source << " at " << message.utime;
      }
    }
    fs::remove(log());
  }
  /// A line of numbers from `first_line` on, one of its values 1e30 or 1e9.
  static void damage(const fs::path& file, int line, const char* value) {
    std::istringstream in(readText(file));
    std::string out;
    int number = 0;
    for (std::string row; std::getline(in, row);) {
      if (++number == line) row.replace(row.rfind(',') + 1, std::string::npos, value);
      out += row + "\n";
    }
    writeText(file, out);
  }
};

TEST_F(ImpossibleRecording, AslFolder) {
  damage(mav() / "imu0" / "data.csv", 20, "1e30");
  expectLeftOut(aslImporter(), folder_.path(), 59);
  damage(mav() / "imu0" / "data.csv", 20, "9.8");
  damage(mav() / "altimeter0" / "data.csv", 2, "1e9");  // at the first frame
  expectLeftOut(aslImporter(), folder_.path(), 60);
  const ImportSummary summary = import();
  EXPECT_EQ(messagesOn<altimeter_t>(readEvents(log()), "ALTIMETER").size(), 2u);
  ASSERT_TRUE(summary.vehicle.start_height);
  EXPECT_EQ(summary.vehicle.start_height->height_m, 8);
}

std::string row(const std::vector<double>& values) {
  std::ostringstream out;
  out.precision(12);
  for (size_t i = 0; i < values.size(); ++i) out << (i > 0 ? "," : "") << values[i];
  return out.str() + "\n";
}

TEST_F(ImpossibleRecording, TablesBesideAVideo) {
  TestVideo video;
  video.image = numbered;
  writeTestVideo(folder_ / "v.mp4", video);
  const fs::path csv = folder_ / "imu.csv", gcsv = folder_ / "v.gcsv", phone = folder_ / "phone";
  std::string plain = "t_s,gx,gy,gz,ax,ay,az\n", counts, gyro, accel;
  for (const ImuSample& sample : swingingImu(200, 1.2)) {
    const double t = seconds(sample.time.time_since_epoch());
    const Eigen::Vector3d &w = sample.gyro, &a = sample.accel;
    plain += row({t, w.x(), w.y(), w.z(), a.x(), a.y(), a.z()});
    counts += row({1e3 * t, w.x(), w.y(), w.z(), a.x() / 9.80665, a.y() / 9.80665, a.z() / 9.80665});
    const std::string time = std::to_string(1'700'000'000'000'000'000 + std::llround(1e9 * t));
    gyro += time + "," + row({t, w.z(), w.y(), w.x()});
    accel += time + "," + row({t, a.z(), a.y(), a.x()});
  }
  writeText(csv, plain);
  writeText(gcsv, "GYROFLOW IMU LOG\nversion,1.3\ntscale,0.001\ngscale,1\nascale,1\nt,gx,gy,gz,ax,ay,az\n" +
                      counts);
  writeText(phone / "Gyroscope.csv", "time,seconds_elapsed,z,y,x\n" + gyro);
  writeText(phone / "TotalAcceleration.csv", "time,seconds_elapsed,z,y,x\n" + accel);
  for (const char* value : {"1e30", "-1e9"}) {
    damage(csv, 50, value);
    expectLeftOut(videoImporter(), folder_ / "v.mp4", 239, csv);
    damage(gcsv, 50, value);
    expectLeftOut(videoImporter(), folder_ / "v.mp4", 239, gcsv);
    damage(phone / "Gyroscope.csv", 50, value);
    expectLeftOut(videoImporter(), folder_ / "v.mp4", 239, phone);
  }
}

/// A payload of floats, gyro and accelerometer, the first of each being `value`.
Bytes floatPayload(int count, float value) {
  const auto stream = [&](const std::string& key, const std::string& unit, float reading) {
    Bytes values;
    for (int k = 0; k < 3 * count; ++k) {
      const float number = k == 0 ? value : reading;
      uint32_t bits = 0;
      std::memcpy(&bits, &number, sizeof bits);
      append(values, bigEndian(bits, 4));
    }
    Bytes inside = text("SIUN", unit);
    append(inside, record(key, 'f', 12, static_cast<size_t>(count), values));
    return container("STRM", inside);
  };
  Bytes inside = stream("ACCL", "m/s\xB2", 5.7F);
  append(inside, stream("GYRO", "rad/s", 0.1F));
  return container("DEVC", inside);
}

TEST_F(ImpossibleRecording, GoprosMotionTrack) {
  for (const float value : {1e30F, -1e9F, std::numeric_limits<float>::quiet_NaN()}) {
    TestVideo video;
    video.image = numbered;
    video.track = {{0, 1, floatPayload(200, value)}, {1, 1, floatPayload(200, 0.5F)}};
    writeTestVideo(folder_ / "g.mp4", video);
    // Without an accelerometer's value the gyro's at its time takes its neighbours'.
    expectLeftOut(goproImporter(), folder_ / "g.mp4", 399);
  }
  TestVideo video;
  video.image = numbered;
  for (int k = 0; k < 20; ++k) video.track.push_back({0.05 * k, 0.05, floatPayload(8, 1e9F)});
  writeTestVideo(folder_ / "g.mp4", video);
  ImportOptions options = goproImporter().defaults;
  options.source = folder_ / "g.mp4";
  options.log = log();
  Progress progress("importing", "frames", true);
  EXPECT_NE(
      errorMessageOf([&] {
        importRecording(goproImporter(), options, progress);
      }).find("g.mp4: 20 of 160 GYRO samples are beyond what any sensor measures: import it as a video"),
      std::string::npos);
}

TEST_F(ImpossibleRecording, RosMessages) {
  for (const double value : {1e30, -1e9}) {
    std::vector<ImuSample> samples = swingingImu(200, 1, 1);
    samples[70].accel.y() = value;
    writeMcapRecording(folder_ / "f.mcap", 0, 20, samples);
    expectLeftOut(mcapImporter(), folder_ / "f.mcap", 199);
  }
}

}  // namespace
}  // namespace redbee::test
