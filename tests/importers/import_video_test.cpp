#include "redbee/importers/import_video.hpp"

#include <opencv2/imgcodecs.hpp>

#include "processes/redbee/vehicle/vehicle_file.hpp"
#include "redbee/bus/image.hpp"
#include "redbee/configuration/configuration.hpp"
#include "redbee/image_t.hpp"
#include "redbee/importers/importer.hpp"
#include "redbee/importers/video_reader.hpp"
#include "redbee/ins_t.hpp"
#include "redbee/results/video_writer.hpp"
#include "tests/support/log_events.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/test_video.hpp"

namespace redbee::test {
namespace {

constexpr int kFrames = 30;

void makeVideo(const fs::path& path) {
  VideoWriter writer(path, {96, 64}, 25);
  for (int k = 0; k < kFrames; ++k) writer.write(texture(96, 64, k, k % 2 == 0 ? 3 : 1));
  writer.close();
}

class ImportVideoTest : public testing::Test {
 protected:
  ImportVideoTest() {
    options_.source = folder_ / "v.mp4";
    options_.log = folder_ / "v.lcm";
    makeVideo(options_.source);
  }
  ImportSummary import() const {
    Progress progress("importing", "frames", true);
    return importRecording(videoImporter(), options_, progress);
  }
  std::string errorMessage() const {
    std::string line = errorMessageOf([&] { import(); });
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    EXPECT_FALSE(fs::exists(options_.log));
    return line;
  }
  ScratchFolder folder_;
  ImportOptions options_;
};

TEST_F(ImportVideoTest, FramesKeepTheirTimesAndAppearance) {
  const ImportSummary summary = import();
  EXPECT_EQ(summary.frames, kFrames);
  EXPECT_EQ(summary.vehicle.width, 96);
  EXPECT_FALSE(summary.vehicle.has_imu);
  const auto frames = messagesOn<image_t>(readEvents(options_.log), "CAMERA");
  ASSERT_EQ(frames.size(), static_cast<size_t>(kFrames));
  double worst = 0;
  for (int k = 0; k < kFrames; ++k) {
    EXPECT_EQ(frames[static_cast<size_t>(k)].utime, 40'000 * k);
    const auto grey = decodeGrey(frames[static_cast<size_t>(k)]);
    ASSERT_TRUE(grey);
    worst = std::max(worst, cv::norm(*grey, texture(96, 64, k, 1), cv::NORM_L1) / (96 * 64));
  }
  std::cout << "mean difference to the encoded images, worst frame: " << worst << " grey levels\n";
  EXPECT_LT(worst, 8);
}

TEST_F(ImportVideoTest, TheConfigurationBesideTheLogRunsOnVisionAlone) {
  const ImportSummary summary = import();
  const Configuration configuration = loadConfiguration(writeVehicleFile(summary.vehicle, options_.log));
  EXPECT_FALSE(configuration.has_imu);
  EXPECT_EQ(configuration.camera.width, 96);
  EXPECT_DOUBLE_EQ(configuration.camera.cx, 47.5);
  EXPECT_DOUBLE_EQ(configuration.camera.fx, 0.8 * 96);
  ASSERT_EQ(summary.warnings.size(), 1u);
  EXPECT_NE(summary.warnings[0].find("77 px are assumed"), std::string::npos) << summary.warnings[0];
}

TEST_F(ImportVideoTest, PixelsThatAreNotSquareHaveTwoFocalLengths) {
  TestVideo video;
  video.frames = 3;
  video.pixel_aspect = {16, 15};
  video.image = [](int k) { return texture(96, 64, k, 1); };
  writeTestVideo(options_.source, video);
  const ImportSummary summary = import();
  const Configuration configuration = loadConfiguration(writeVehicleFile(summary.vehicle, options_.log));
  EXPECT_DOUBLE_EQ(configuration.camera.fx, 0.8 * 96);
  EXPECT_NEAR(configuration.camera.fy, 0.8 * 96 * 16 / 15, 1e-6);
}

TEST_F(ImportVideoTest, AChosenWidthKeepsTheAspect) {
  options_.width = 49;
  options_.format = FrameFormat::kRawGrey;
  import();
  const auto frames = messagesOn<image_t>(readEvents(options_.log), "CAMERA");
  ASSERT_EQ(frames.size(), static_cast<size_t>(kFrames));
  EXPECT_EQ(frames[0].width, 48);
  EXPECT_EQ(frames[0].height, 32);
  EXPECT_EQ(frames[0].pixelformat, image_t::GRAY);
  EXPECT_EQ(frames[0].size, 48 * 32);
}

TEST_F(ImportVideoTest, ImuColumnsComeInAnyOrder) {
  options_.imu = folder_ / "imu.csv";
  std::string rows = "az,t_s,gx,gy,gz,ax,ay,temperature\n";
  for (int k = 0; k < 120; ++k) {
    const std::string digit = std::to_string(k % 2);  // a sensor that is alive changes
    for (const std::string& part : {"9." + digit, std::to_string(0.01 * k + 0.001), "0.1" + digit,
                                    "0.2" + digit, "0.3" + digit, "1." + digit, "2." + digit}) {
      rows.append(part).append(",");
    }
    rows += "20\n";
  }
  writeText(*options_.imu, rows);
  const ImportSummary summary = import();
  EXPECT_EQ(summary.imu_samples, 120);
  ASSERT_EQ(summary.warnings.size(), 2u);
  EXPECT_NE(summary.warnings[0].find("focal length"), std::string::npos);
  EXPECT_NE(summary.warnings[1].find("mounted on the IMU (camera.R_CI) is not known"), std::string::npos);
  const auto imu = messagesOn<ins_t>(readEvents(options_.log), "IMU");
  ASSERT_EQ(imu.size(), 120u);
  EXPECT_EQ(imu[119].utime, 1'191'000);
  EXPECT_EQ(imu[119].gyro[2], 0.31);
  EXPECT_EQ(imu[119].accel[2], 9.1);
}

TEST_F(ImportVideoTest, BadImuFilesAreReportedWithTheirLine) {
  options_.imu = folder_ / "imu.csv";
  const auto complaintFor = [&](const std::string& text) {
    writeText(*options_.imu, text);
    return errorMessage();
  };
  const std::string header = "t_s,gx,gy,gz,ax,ay,az\n";
  EXPECT_NE(complaintFor("0,1,2,3,4,5,6\n").find("imu.csv:1: header names no column 't_s'"),
            std::string::npos);
  EXPECT_NE(complaintFor(header).find("imu.csv: holds no samples"), std::string::npos);
  EXPECT_NE(complaintFor("").find("imu.csv: is empty"), std::string::npos);
  EXPECT_NE(complaintFor(header + "0,1,2,3,4,5\n").find("imu.csv:2: has 6 columns"), std::string::npos);
  EXPECT_NE(complaintFor(header + "0,1,2,3,4,5,inf\n").find("imu.csv:2: 'inf'"), std::string::npos);
  EXPECT_NE(complaintFor(header + "1,1,2,3,4,5,6\n0,1,2,3,4,5,6\n").find("imu.csv:3: time runs backwards"),
            std::string::npos);
  EXPECT_NE(complaintFor(header + "1e30,1,2,3,4,5,6\n").find("imu.csv:2: '1e30' s is no time"),
            std::string::npos);
}

TEST_F(ImportVideoTest, ATruncatedVideoNamesItsLastGoodFrame) {
  const std::string whole = readText(options_.source);
  int named = 0;
  for (const double fraction : {0.95, 0.85, 0.8}) {
    writeText(options_.source,
              whole.substr(0, static_cast<size_t>(fraction * static_cast<double>(whole.size()))));
    const std::string line = errorMessage();
    EXPECT_NE(line.find("v.mp4: "), std::string::npos) << line;
    EXPECT_NE(line.find("cut short"), std::string::npos) << line;
    named += line.find("the last good one") != std::string::npos ? 1 : 0;
    std::cout << fraction << ": " << line << "\n";
  }
  EXPECT_EQ(named, 3);
  writeText(options_.source, whole.substr(0, 200));
  EXPECT_NE(errorMessage().find("v.mp4: "), std::string::npos);
}

TEST_F(ImportVideoTest, WhatIsNoVideoIsRefused) {
  writeText(options_.source, "hello");
  EXPECT_NE(errorMessage().find("v.mp4: is no video"), std::string::npos);
  writeText(options_.source, "");
  EXPECT_NE(errorMessage().find("v.mp4: "), std::string::npos);
  writeText(options_.source, "\xED\xA1\xDA\x01 ...");
  EXPECT_NE(errorMessage().find("v.mp4: is a log already"), std::string::npos);
  writeText(options_.source, "#ROSBAG V2.0\n");
  EXPECT_NE(errorMessage().find("v.mp4: is no video: redbee import rosbag"), std::string::npos);
  fs::remove(options_.source);
  EXPECT_NE(errorMessage().find("v.mp4: no such file"), std::string::npos);
}

TEST_F(ImportVideoTest, AFolderOfImagesIsAVideoToo) {
  options_.source = folder_ / "images";
  fs::create_directories(options_.source);
  EXPECT_NE(errorMessageOf([&] {
              options_.fps = 10;
              import();
            }).find("holds no JPEG or PNG"),
            std::string::npos);
  for (int k = 0; k < 3; ++k) {
    cv::imwrite((options_.source / ("0" + std::to_string(k) + ".jpg")).string(), texture(32, 32, k, 3));
  }
  options_.fps = 0;
  EXPECT_NE(errorMessage().find("frame rate"), std::string::npos);
  options_.fps = 10;
  EXPECT_EQ(import().frames, 3);
  EXPECT_EQ(messagesOn<image_t>(readEvents(options_.log), "CAMERA")[2].utime, 200'000);
}

TEST(VideoWriterTest, NothingIsLeftWithoutClose) {
  const ScratchFolder folder;
  {
    VideoWriter writer(folder / "v.mp4", {64, 64}, 25);
    writer.write(texture(64, 64, 0, 3));
  }
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(VideoWriterTest, RefusesWhatItCannotEncode) {
  const ScratchFolder folder;
  EXPECT_THROW(VideoWriter(folder / "v.mp4", {63, 64}, 25), std::invalid_argument);
  EXPECT_THROW(VideoWriter(folder / "v.mp4", {64, 64}, 0), std::invalid_argument);
  EXPECT_THROW(VideoWriter(folder / "none" / "v.mp4", {64, 64}, 25), InputError);
  VideoWriter writer(folder / "v.mp4", {64, 64}, 25);
  EXPECT_THROW(writer.write(texture(32, 64, 0, 3)), std::invalid_argument);
}

}  // namespace
}  // namespace redbee::test
