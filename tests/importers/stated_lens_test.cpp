// Focal lengths beside the images: DJI's subtitles, EXIF.
#include "redbee/importers/stated_lens.hpp"

#include <gmock/gmock.h>

#include <opencv2/imgcodecs.hpp>

#include "processes/redbee/vehicle/vehicle_file.hpp"
#include "redbee/configuration/configuration.hpp"
#include "redbee/importers/import_video.hpp"
#include "redbee/importers/importer.hpp"
#include "redbee/lens_t.hpp"
#include "tests/support/exif.hpp"
#include "tests/support/log_events.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/test_video.hpp"

namespace redbee::test {
namespace {

using testing::HasSubstr;

class StatedLensTest : public testing::Test {
 protected:
  ImportSummary import(const fs::path& source) {
    ImportOptions options;
    options.source = source;
    options.log = folder_ / "flight.lcm";
    options.fps = fs::is_directory(source) ? 10 : 0;
    fs::remove(options.log);
    Progress progress("importing", "frames", true);
    return importRecording(videoImporter(), options, progress);
  }
  std::vector<lens_t> lensMessages() const {
    return messagesOn<lens_t>(readEvents(folder_ / "flight.lcm"), "LENS");
  }
  ScratchFolder folder_;
};

void writeVideo(const fs::path& file) {
  TestVideo recording;
  recording.image = [](int frame) { return cv::Mat(64, 96, CV_8UC1, cv::Scalar(40 + 4 * frame)); };
  writeTestVideo(file, recording);
}

/// As its newer cameras write it.
std::string subtitle(int k, double focal, double crop) {
  char text[256];
  std::snprintf(text, sizeof text,
                "%d\n00:00:00,%03d --> 00:00:00,%03d\n<font size=\"28\">FrameCnt: %d, DiffTime: 40ms\n"
                "[iso: 100] [shutter: 1/500.0] [ct: 5500] [focal_len: %.2f] [dzoom_ratio: %.2f] </font>\n\n",
                k + 1, 40 * k, 40 * (k + 1), k + 1, focal, crop);
  return text;
}

TEST_F(StatedLensTest, SubtitlesOfDjiBecomeLens) {
  writeVideo(folder_ / "DJI_1.mp4");
  std::string text;
  for (int k = 0; k < 5; ++k) text += subtitle(k, 24 + k, k == 4 ? 2 : 1);
  writeText(folder_ / "DJI_1.SRT", text);
  const ImportSummary summary = import(folder_ / "DJI_1.mp4");
  const std::vector<lens_t> lens = lensMessages();
  ASSERT_EQ(lens.size(), 5U);
  for (int k = 0; k < 5; ++k) {
    const lens_t& m = lens[static_cast<size_t>(k)];
    EXPECT_EQ(m.utime, 40000 * k);
    EXPECT_EQ(m.has_focal_length, 1);
    EXPECT_NEAR(m.focal_length / m.width, (24 + k) * (k == 4 ? 2 : 1) / 36.0, 1e-9);
  }
  const Configuration vehicle = loadConfiguration(writeVehicleFile(summary.vehicle, folder_ / "flight.lcm"));
  EXPECT_TRUE(vehicle.inertial.lens.enabled);
  EXPECT_TRUE(vehicle.inertial.lens.on_camera_clock) << "LENS has the images' times";
  EXPECT_NEAR(vehicle.inertial.lens.focal_length_px, 24 / 36.0 * vehicle.camera.width, 1e-3);
}

TEST_F(StatedLensTest, OlderSubtitlesCountInTenthsAndTenThousandths) {
  writeText(
      folder_ / "a.srt",
      "1\n00:00:01,500 --> 00:00:01,533\n[fnum : 280] [focal_len : 240] [dzoom_ratio: 10000, delta:0]\n\n"
      "2\n00:01:01,533 --> 00:01:01,566\n[focal_len : 240] [dzoom_ratio: 15000, delta:0]\n");
  const auto found = readDjiSubtitles(folder_ / "a.srt");
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].utime, 1500000);
  EXPECT_NEAR(found[0].mm, 24, 1e-9);
  EXPECT_EQ(found[1].utime, 61533000);
  EXPECT_NEAR(found[1].mm, 36, 1e-9);
}

TEST_F(StatedLensTest, WhatIsNoFocalLengthIsLeftOutAndSaid) {
  writeVideo(folder_ / "v.mp4");
  writeText(folder_ / "v.srt", "1\n00:00:00,000 --> 00:00:02,000\nHello.\n");
  const ImportSummary summary = import(folder_ / "v.mp4");
  EXPECT_TRUE(lensMessages().empty());
  EXPECT_FALSE(summary.vehicle.lens_focal_px);
  EXPECT_THAT(summary.warnings, testing::Contains(HasSubstr("v.srt: states no focal length")));
  writeText(folder_ / "bad.srt",
            "1\n99:99:00,000 --> x\n[focal_len : 24.0]\n2\n00:00:00,000 --> \n[focal_len : -3]\n"
            "3\n00:00:01,000 --> \n[focal_len : nan]\n4\n00:00:02,000 -->\n[focal_len]\n");
  EXPECT_TRUE(readDjiSubtitles(folder_ / "bad.srt").empty());
}

TEST_F(StatedLensTest, AFixedLensNeedsNoMessages) {
  writeVideo(folder_ / "v.mp4");
  writeText(folder_ / "v.SRT", subtitle(0, 24, 1) + subtitle(1, 24, 1));
  EXPECT_FALSE(import(folder_ / "v.mp4").vehicle.lens_focal_px);
}

TEST_F(StatedLensTest, ExifOfImagesBecomesLens) {
  fs::create_directories(folder_ / "images");
  const cv::Mat1b image(48, 64, uchar{90});
  for (int k = 0; k < 3; ++k) {
    writeText(folder_ / "images" / (std::to_string(k) + ".jpg"),
              withExifLens(image, {8.8 + 0.8 * k, 24.0, k == 2 ? 1.5 : 1}));
  }
  const ImportSummary summary = import(folder_ / "images");
  const std::vector<lens_t> lens = lensMessages();
  ASSERT_EQ(lens.size(), 3U);
  const double expected_mm[] = {24, 24 * 9.6 / 8.8, 24 * 10.4 / 8.8 * 1.5};
  for (size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(lens[k].utime, static_cast<int64_t>(100000 * k));
    EXPECT_NEAR(lens[k].focal_length / lens[k].width * 36, expected_mm[k], 1e-6);
  }
  EXPECT_NEAR(summary.vehicle.lens_focal_px.value(), 24 / 36.0 * 64, 1e-6);
}

}  // namespace
}  // namespace redbee::test
