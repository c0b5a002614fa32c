#include "redbee/importers/import_asl.hpp"

#include <yaml-cpp/yaml.h>

#include "redbee/altimeter_t.hpp"
#include "redbee/bus/image.hpp"
#include "redbee/image_t.hpp"
#include "redbee/ins_t.hpp"
#include "tests/support/scratch.hpp"

namespace redbee {
namespace {

using namespace testing;  // NOLINT: the test's own helpers

constexpr int64_t kStart = 1'600'000'000'000'000'000;  // ns

/// A whole ASL flight of five frames at 20 Hz, IMU at 200 Hz, altimeter at 10 Hz; the tests damage it.
class ImportAslTest : public ::testing::Test {
 protected:
  ImportAslTest() {
    std::string list = "#timestamp [ns],filename\n";
    for (int k = 0; k < 5; ++k) {
      const std::string name = std::to_string(kStart + k * 50'000'000LL) + ".jpg";
      list += std::to_string(kStart + k * 50'000'000LL + 600) + "," + name + "\n";
      fs::create_directories(mav() / "cam0" / "data");
      cv::imwrite((mav() / "cam0" / "data" / name).string(), texture(64, 48, k, 3));
      images_.push_back(mav() / "cam0" / "data" / name);
    }
    std::string imu = "#timestamp [ns],w,w,w,a,a,a\n";
    for (int k = -10; k < 50; ++k) {
      imu +=
          std::to_string(kStart + k * 5'000'000LL) + ",0.1,0.2," + std::to_string(0.001 * k) + ",1,2,9.8\n";
    }
    std::string altitudes = "#timestamp [ns],height\n";
    for (int k = 0; k < 3; ++k)
      altitudes += std::to_string(kStart + k * 100'000'000LL) + "," + std::to_string(7 + k) + "\n";
    writeText(mav() / "cam0" / "data.csv", list);
    writeText(mav() / "imu0" / "data.csv", imu);
    writeText(mav() / "altimeter0" / "data.csv", altitudes);
    writeText(mav() / "altimeter0" / "sensor.yaml", "sensor_type: altimeter\nnoise_sigma: 0.05\n");
    writeText(mav() / "cam0" / "sensor.yaml",
              "%YAML:1.0\nT_BS:\n  cols: 4\n  rows: 4\n  data: [0,0,1,0.1, -1,0,0,0.2, 0,-1,0,0.3, 0,0,0,1]\n"
              "resolution: [64, 48]\ncamera_model: pinhole\nintrinsics: [50, 51, 31.5, 23.5]\n"
              "distortion_model: radial-tangential\ndistortion_coefficients: [0.1, 0.2, 0.3, 0.4]\n");
    writeText(mav() / "imu0" / "sensor.yaml",
              "%YAML:1.0\ngyroscope_noise_density: 1e-4\ngyroscope_random_walk: 2e-5\n"
              "accelerometer_noise_density: 3e-3\naccelerometer_random_walk: 4e-4\n");
  }

  fs::path mav() const { return folder_ / "mav0"; }
  fs::path log() const { return folder_ / "out.lcm"; }
  ImportSummary import() const {
    Progress progress("importing", "frames", true);
    AslImportOptions options;
    options.folder = folder_.path();
    options.log = log();
    return importAsl(options, progress);
  }
  /// The complaint; fails where it holds more than one line or leaves a log behind.
  std::string complaint() const {
    std::string line = complaintOf([&] { import(); });
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    EXPECT_FALSE(fs::exists(log()));
    EXPECT_FALSE(fs::exists(log().string() + ".partial"));
    return line;
  }
  void replaceLine(const fs::path& file, int line, const std::string& text) const {
    std::ifstream in(file);
    std::string out;
    int number = 0;
    for (std::string row; std::getline(in, row);) out += (++number == line ? text : row) + "\n";
    writeText(file, out);
  }
  std::string lineOf(const fs::path& file, int line) const {
    std::ifstream in(file);
    std::string row;
    for (int k = 0; k < line; ++k) std::getline(in, row);
    return row;
  }

  ScratchFolder folder_;
  std::vector<fs::path> images_;
};

TEST_F(ImportAslTest, AWholeFlightBecomesALogInTheOrderOfTime) {
  const ImportSummary summary = import();
  EXPECT_EQ(summary.frames, 5);
  EXPECT_EQ(summary.imu_samples, 60);
  EXPECT_EQ(summary.altitudes, 3);
  EXPECT_NEAR(summary.imu_rate_hz, 200, 1e-6);
  EXPECT_TRUE(summary.warnings.empty());

  const auto events = readEvents(log());
  EXPECT_EQ(events.size(), 68u);
  EXPECT_TRUE(isSortedByTime(events));
  const auto frames = messagesOn<image_t>(events, "CAMERA");
  ASSERT_EQ(frames.size(), 5u);
  // 600 ns past the microsecond: rounded up, not cut off.
  EXPECT_EQ(frames[0].utime, kStart / 1000 + 1);
  EXPECT_EQ(frames[0].pixelformat, kMjpeg);
  const std::string original = readText(images_[0]);
  EXPECT_EQ(std::string(frames[0].data.begin(), frames[0].data.end()), original)
      << "the JPEG's bytes were touched";
  const auto imu = messagesOn<ins_t>(events, "IMU");
  EXPECT_EQ(imu[10].utime, kStart / 1000);
  EXPECT_EQ(imu[10].gyro[1], 0.2);
  EXPECT_EQ(imu[10].accel[2], 9.8);
  const auto altitudes = messagesOn<altimeter_t>(events, "ALTIMETER");
  EXPECT_EQ(altitudes[1].height, 8);
  EXPECT_EQ(altitudes[1].sigma, 0.05);
}

TEST_F(ImportAslTest, TheVehicleIsDescribed) {
  const VehicleDescription vehicle = import().vehicle;
  ASSERT_TRUE(vehicle.intrinsics && vehicle.R_CI && vehicle.p_IC && vehicle.noise && vehicle.start_height);
  Eigen::Matrix3d R_CI;
  R_CI << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  EXPECT_LT((*vehicle.R_CI - R_CI).norm(), 1e-12);
  EXPECT_LT((*vehicle.p_IC - Eigen::Vector3d(0.1, 0.2, 0.3)).norm(), 1e-12);
  EXPECT_EQ(vehicle.noise->accel_noise_density, 3e-3);
  EXPECT_EQ(vehicle.start_height->height_m, 7);

  const YAML::Node yaml = YAML::LoadFile(writeVehicleConfiguration(vehicle, log()).string());
  EXPECT_EQ(yaml["camera"]["fy"].as<double>(), 51);
  EXPECT_EQ(yaml["camera"]["distortion"][3].as<double>(), 0.4);
  EXPECT_EQ(yaml["camera"]["R_CI"][6].as<double>(), 1);
  EXPECT_EQ(yaml["plane"]["height_m"].as<double>(), 7);
  EXPECT_TRUE(yaml["imu"]["present"].as<bool>());
}

TEST_F(ImportAslTest, TheVehicleFolderItselfWillDo) {
  AslImportOptions options;
  options.folder = mav();
  options.log = log();
  Progress progress("importing", "frames", true);
  EXPECT_EQ(importAsl(options, progress).frames, 5);
}

TEST_F(ImportAslTest, WithoutImuAndAltimeterThereIsVisionOnly) {
  fs::remove_all(mav() / "imu0");
  fs::remove_all(mav() / "altimeter0");
  const ImportSummary summary = import();
  EXPECT_EQ(summary.frames, 5);
  EXPECT_FALSE(summary.vehicle.has_imu);
  EXPECT_FALSE(summary.vehicle.start_height);
}

TEST_F(ImportAslTest, GreyPngsKeepEveryPixel) {
  for (size_t k = 0; k < images_.size(); ++k) {
    const cv::Mat grey = texture(64, 48, static_cast<int>(k), 1);
    cv::imwrite(images_[k].string() + ".png", grey);
    fs::rename(images_[k].string() + ".png", images_[k]);
  }
  import();
  const auto frames = messagesOn<image_t>(readEvents(log()), "CAMERA");
  ASSERT_EQ(frames.size(), 5u);
  EXPECT_EQ(frames[2].pixelformat, kGray);
  const auto grey = decodeGrey(frames[2]);
  ASSERT_TRUE(grey);
  EXPECT_EQ(cv::norm(*grey, texture(64, 48, 2, 1), cv::NORM_INF), 0);
}

TEST_F(ImportAslTest, AnImuThatMissesTheFramesIsAWarning) {
  writeText(mav() / "imu0" / "data.csv", "1000,0,0,0,0,0,9.8\n5001000,0,0,0,0,0,9.8\n");
  const ImportSummary summary = import();
  ASSERT_EQ(summary.warnings.size(), 1u);
  EXPECT_NE(summary.warnings[0].find("covers none of the frames"), std::string::npos) << summary.warnings[0];
}

TEST_F(ImportAslTest, BadInputIsToldWithFileAndLine) {
  const fs::path list = mav() / "cam0" / "data.csv";
  const fs::path imu = mav() / "imu0" / "data.csv";
  struct Case {
    const char* what;
    std::function<void()> damage;
    std::string file_and_line;
    const char* words;
  };
  const auto copyOf = [](const fs::path& file) { return readText(file); };
  const std::string good_list = copyOf(list);
  const std::string good_imu = copyOf(imu);
  const std::string good_image = copyOf(images_[3]);
  const std::string good_sensor = copyOf(mav() / "cam0" / "sensor.yaml");
  const std::vector<Case> cases = {
      {"no list", [&] { fs::remove(list); }, "cam0/data.csv: ", "no such file"},
      {"no images listed", [&] { writeText(list, "#timestamp,filename\n"); },
       "cam0/data.csv: ", "lists no images"},
      {"a image is missing", [&] { fs::remove(images_[3]); }, "cam0/data.csv:5: ", "is missing"},
      {"truncated JPEG", [&] { fs::resize_file(images_[3], good_image.size() / 2); }, images_[3].string(),
       "cut short"},
      {"JPEG header only", [&] { fs::resize_file(images_[3], 20); }, images_[3].string(), "header"},
      {"no image at all", [&] { writeText(images_[3], "hello"); }, images_[3].string(),
       "neither JPEG nor PNG"},
      {"empty image", [&] { writeText(images_[3], ""); }, images_[3].string(), "is an empty file"},
      {"mixed resolutions", [&] { cv::imwrite(images_[3].string(), texture(32, 48, 0, 3)); },
       images_[3].string(), "32x48"},
      {"frames run backwards", [&] { replaceLine(list, 4, std::to_string(kStart) + ",a.jpg"); },
       "cam0/data.csv:4: ", "backwards"},
      {"frames repeat", [&] { replaceLine(list, 4, lineOf(list, 3)); }, "cam0/data.csv:4: ", "repeats"},
      {"frame without name", [&] { replaceLine(list, 4, "17"); },
       "cam0/data.csv:4: ", "1 columns instead of 2"},
      {"frame time is no number", [&] { replaceLine(list, 4, "1e9,a.jpg"); },
       "cam0/data.csv:4: ", "no whole number"},
      {"IMU NaN", [&] { replaceLine(imu, 9, std::to_string(kStart - 15'000'000) + ",nan,0,0,0,0,9"); },
       "imu0/data.csv:9: ", "not finite"},
      {"IMU infinity", [&] { replaceLine(imu, 9, std::to_string(kStart - 15'000'000) + ",0,0,0,0,0,-inf"); },
       "imu0/data.csv:9: ", "not finite"},
      {"IMU columns", [&] { replaceLine(imu, 9, "1,2,3"); }, "imu0/data.csv:9: ", "3 columns instead of 7"},
      {"IMU backwards", [&] { replaceLine(imu, 9, lineOf(imu, 4)); }, "imu0/data.csv:9: ", "backwards"},
      {"IMU repeats", [&] { replaceLine(imu, 9, lineOf(imu, 8)); }, "imu0/data.csv:9: ", "repeats"},
      {"IMU empty", [&] { writeText(imu, "#t\n"); }, "imu0/data.csv: ", "holds no samples"},
      {"IMU list missing", [&] { fs::remove(imu); }, "imu0/data.csv: ", "no such file"},
      {"no rotation",
       [&] {
         replaceLine(mav() / "cam0" / "sensor.yaml", 5, "  data: [0,0,1,0, 1,0,0,0, 0,1,1,0, 0,0,0,1]");
       },
       "cam0/sensor.yaml:3: ", "T_BS"},
      {"other distortion model",
       [&] { replaceLine(mav() / "cam0" / "sensor.yaml", 9, "distortion_model: equidistant"); },
       "cam0/sensor.yaml:9: ", "equidistant"},
      {"calibration of another size",
       [&] { replaceLine(mav() / "cam0" / "sensor.yaml", 6, "resolution: [640, 480]"); },
       "cam0/sensor.yaml: ", "640x480"},
      {"broken yaml", [&] { replaceLine(mav() / "cam0" / "sensor.yaml", 6, "resolution: [64, 48"); },
       "cam0/sensor.yaml:", ""},
  };
  for (const Case& bad : cases) {
    bad.damage();
    const std::string line = complaint();
    EXPECT_NE(line.find(bad.file_and_line), std::string::npos) << bad.what << ": " << line;
    EXPECT_NE(line.find(bad.words), std::string::npos) << bad.what << ": " << line;
    writeText(list, good_list);
    writeText(imu, good_imu);
    writeText(images_[3], good_image);
    writeText(mav() / "cam0" / "sensor.yaml", good_sensor);
  }
  EXPECT_EQ(import().frames, 5) << "the damage was not mended between the cases";
}

TEST_F(ImportAslTest, AnEmptyFolderIsRefused) {
  AslImportOptions options;
  options.folder = folder_ / "empty";
  options.log = log();
  fs::create_directories(options.folder);
  Progress progress("importing", "frames", true);
  EXPECT_NE(complaintOf([&] { importAsl(options, progress); }).find("holds neither mav0 nor cam0"),
            std::string::npos);
  options.folder = folder_ / "none";
  EXPECT_NE(complaintOf([&] { importAsl(options, progress); }).find("no such folder"), std::string::npos);
}

struct Recorded {
  const char* flight;
  int64_t frames;
  double imu_rate_hz;
  bool altimeter;
};

class RecordedAslTest : public ::testing::TestWithParam<Recorded> {};

TEST_P(RecordedAslTest, Imports) {
  const auto flight = recordedFlight(GetParam().flight);
  if (!flight) GTEST_SKIP() << "the recorded flights are not here (REDBEE_SHARED)";
  const ScratchFolder folder;
  AslImportOptions options;
  options.folder = *flight;
  options.log = folder / "f.lcm";
  Progress progress("importing", "frames", true);
  const ImportSummary summary = importAsl(options, progress);
  EXPECT_EQ(summary.frames, GetParam().frames);
  EXPECT_NEAR(summary.imu_rate_hz, GetParam().imu_rate_hz, 1);
  EXPECT_EQ(summary.altitudes > 0, GetParam().altimeter);
  EXPECT_EQ(summary.vehicle.start_height.has_value(), GetParam().altimeter);
  ASSERT_TRUE(summary.vehicle.R_CI);
  EXPECT_NEAR(
      (summary.vehicle.R_CI->transpose() * *summary.vehicle.R_CI - Eigen::Matrix3d::Identity()).norm(), 0,
      1e-12);
  for (const std::string& warning : summary.warnings) std::cout << warning << "\n";
  const auto events = readEvents(options.log);
  EXPECT_TRUE(isSortedByTime(events));
  EXPECT_EQ(static_cast<int64_t>(messagesOn<image_t>(events, "CAMERA").size()), GetParam().frames);
  std::cout << GetParam().flight << ": " << summary.frames << " frames, IMU " << summary.imu_rate_hz
            << " Hz\n";
}

INSTANTIATE_TEST_SUITE_P(Flights, RecordedAslTest,
                         ::testing::Values(Recorded{"euroc_v101", 90, 200, false},
                                           Recorded{"rendered/park1", 240, 400, true}),
                         [](const auto& instance) {
                           return instance.index == 0 ? std::string("euroc") : std::string("park1");
                         });

}  // namespace
}  // namespace redbee
