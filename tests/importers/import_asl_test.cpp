#include "redbee/importers/import_asl.hpp"

#include <yaml-cpp/yaml.h>

#include "processes/redbee/vehicle/vehicle_file.hpp"
#include "redbee/altimeter_t.hpp"
#include "redbee/bus/image.hpp"
#include "redbee/image_t.hpp"
#include "redbee/ins_t.hpp"
#include "tests/support/asl_folder.hpp"
#include "tests/support/shared_flight.hpp"

namespace redbee::test {
namespace {

class ImportAslTest : public AslFolder {};

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
  EXPECT_EQ(frames[0].utime, kAslStart / 1000 + 1);
  EXPECT_EQ(frames[0].pixelformat, image_t::MJPEG);
  const std::string original = readText(images_[0]);
  EXPECT_EQ(std::string(frames[0].data.begin(), frames[0].data.end()), original)
      << "the JPEG's bytes were touched";
  const auto imu = messagesOn<ins_t>(events, "IMU");
  EXPECT_EQ(imu[10].utime, kAslStart / 1000);
  EXPECT_EQ(imu[10].gyro[1], 0.2);
  EXPECT_EQ(imu[10].accel[2], 9.8);
  const auto altitudes = messagesOn<altimeter_t>(events, "ALTIMETER");
  EXPECT_EQ(altitudes[1].height, 8);
  EXPECT_EQ(altitudes[1].sigma, 0.05);
}

/// As kalibr_bagcreater takes it (github.com/ethz-asl/kalibr/wiki/bag-format).
TEST_F(ImportAslTest, KalibrsFoldersHaveNoList) {
  for (const fs::path& image : images_) fs::rename(image, mav() / "cam0" / image.filename());
  fs::remove_all(mav() / "cam0" / "data");
  fs::remove(mav() / "cam0" / "data.csv");
  std::string imu = readText(mav() / "imu0" / "data.csv");
  imu.replace(0, imu.find('\n'), "timestamp,omega_x,omega_y,omega_z,alpha_x,alpha_y,alpha_z");
  writeText(mav() / "imu0.csv", imu);
  fs::remove_all(mav() / "imu0");
  const ImportSummary summary = import();
  EXPECT_EQ(summary.frames, 5);
  EXPECT_EQ(summary.imu_samples, 60);
  const auto frames = messagesOn<image_t>(readEvents(log()), "CAMERA");
  ASSERT_EQ(frames.size(), 5u);
  EXPECT_EQ(frames[3].utime, kAslStart / 1000 + 150'000);
  for (const auto& entry : fs::directory_iterator(mav() / "cam0")) fs::remove(entry.path());
  EXPECT_NE(errorMessageOf([&] { import(); }).find("nor images named by their time"), std::string::npos);
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

  const YAML::Node yaml = YAML::LoadFile(writeVehicleFile(vehicle, log()).string());
  EXPECT_EQ(yaml["camera"]["fy"].as<double>(), 51);
  EXPECT_EQ(yaml["camera"]["distortion"][3].as<double>(), 0.4);
  EXPECT_EQ(yaml["camera"]["R_CI"][6].as<double>(), 1);
  EXPECT_EQ(yaml["plane"]["height_m"].as<double>(), 7);
  EXPECT_TRUE(yaml["imu"]["present"].as<bool>());
}

TEST_F(ImportAslTest, TheVehicleFolderItselfWillDo) {
  ImportOptions options;
  options.source = mav();
  options.log = log();
  Progress progress("importing", "frames", true);
  EXPECT_EQ(aslImporter().import(options, progress).frames, 5);
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
  EXPECT_EQ(frames[2].pixelformat, image_t::GRAY);
  const auto grey = decodeGrey(frames[2]);
  ASSERT_TRUE(grey);
  EXPECT_EQ(cv::norm(*grey, texture(64, 48, 2, 1), cv::NORM_INF), 0);
}

TEST_F(ImportAslTest, HeadersNeedNoHash) {
  for (const char* table : {"cam0/data.csv", "imu0/data.csv", "altimeter0/data.csv"}) {
    const std::string text = readText(mav() / table);
    ASSERT_EQ(text.front(), '#');
    writeText(mav() / table, text.substr(1));
  }
  const ImportSummary summary = import();
  EXPECT_EQ(summary.frames, 5);
  EXPECT_EQ(summary.imu_samples, 60);
  EXPECT_EQ(summary.altitudes, 3);
}

TEST_F(ImportAslTest, AHandfulOfImuSamplesThatMissTheFramesIsSaid) {
  writeText(mav() / "imu0" / "data.csv", "1000,0,0,0,0,0,9.8\n5001000,0,0,0,0,0,9.8\n");
  const ImportSummary summary = import();
  ASSERT_EQ(summary.warnings.size(), 2u);
  EXPECT_NE(summary.warnings[0].find("the IMU has 2 samples"), std::string::npos) << summary.warnings[0];
  EXPECT_NE(summary.warnings[1].find("covers none of the frames"), std::string::npos) << summary.warnings[1];
}

struct Recorded {
  const char* flight;
  int64_t frames;
  double imu_rate_hz;
  bool altimeter;
};

class RecordedAslTest : public testing::TestWithParam<Recorded> {};

TEST_P(RecordedAslTest, Imports) {
  const auto flight = sharedFlight(GetParam().flight);
  if (!flight) GTEST_SKIP() << "the recorded flights are not here (REDBEE_SHARED)";
  const ScratchFolder folder;
  ImportOptions options;
  options.source = *flight;
  options.log = folder / "f.lcm";
  Progress progress("importing", "frames", true);
  const ImportSummary summary = aslImporter().import(options, progress);
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
                         testing::Values(Recorded{"euroc_v101", 90, 200, false},
                                         Recorded{"rendered/park1", 240, 400, true}),
                         [](const auto& instance) {
                           return instance.index == 0 ? std::string("euroc") : std::string("park1");
                         });

}  // namespace
}  // namespace redbee::test
