// A small flight in the ASL layout, which tests may damage before importing it.
#pragma once

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "redbee/importers/import_asl.hpp"
#include "tests/support/log_events.hpp"
#include "tests/support/scratch_folder.hpp"

namespace redbee::test {

inline constexpr int64_t kAslStart = 1'600'000'000'000'000'000;  // ns

/// An ASL flight of five frames at 20 Hz, IMU at 200 Hz, altimeter at 10 Hz.
class AslFolder : public testing::Test {
 protected:
  AslFolder() {
    std::string list = "#timestamp [ns],filename\n";
    for (int k = 0; k < 5; ++k) {
      const std::string name = std::to_string(kAslStart + k * 50'000'000LL) + ".jpg";
      list += std::to_string(kAslStart + k * 50'000'000LL + 600) + "," + name + "\n";
      fs::create_directories(mav() / "cam0" / "data");
      cv::imwrite((mav() / "cam0" / "data" / name).string(), texture(64, 48, k, 3));
      images_.push_back(mav() / "cam0" / "data" / name);
    }
    std::string imu = "#timestamp [ns],w,w,w,a,a,a\n";
    for (int k = -10; k < 50; ++k) {
      imu += std::to_string(kAslStart + k * 5'000'000LL) + "," + std::to_string(0.1 + 1e-4 * k) + "," +
             std::to_string(0.2 - 1e-4 * k) + "," + std::to_string(0.001 * k) + "," +
             std::to_string(1 + 1e-3 * k) + "," + std::to_string(2 - 1e-3 * k) + "," +
             std::to_string(9.8 + 1e-3 * k) + "\n";
    }
    std::string altitudes = "#timestamp [ns],height\n";
    for (int k = 0; k < 3; ++k)
      altitudes += std::to_string(kAslStart + k * 100'000'000LL) + "," + std::to_string(7 + k) + "\n";
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
    ImportOptions options;
    options.source = folder_.path();
    options.log = log();
    return aslImporter().import(options, progress);
  }
  /// The import's error message. The test fails if it has several lines or a log is left behind.
  std::string errorMessage() const {
    std::string line = errorMessageOf([&] { import(); });
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

}  // namespace redbee::test
