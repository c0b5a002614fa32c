// GoPro files whose motion track does not lie simply beside the video: cut, stabilised, time lapse, chapters.
#include <gtest/gtest.h>

#include <cmath>

#include "redbee/bus/image.hpp"
#include "redbee/gimbal_t.hpp"
#include "redbee/image_t.hpp"
#include "redbee/importers/import_gopro.hpp"
#include "redbee/ins_t.hpp"
#include "tests/support/gpmf_bytes.hpp"
#include "tests/support/log_events.hpp"
#include "tests/support/mp4_edits.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/shared_flight.hpp"
#include "tests/support/test_video.hpp"

namespace redbee::test {
namespace {

class GoproFileTest : public testing::Test {
 protected:
  GoproFileTest() {
    video_.image = numbered;
    video_.frames = 50;
    options_.source = folder_ / "GX010007.MP4";
    options_.log = folder_ / "f.lcm";
  }
  ImportSummary import() {
    Progress progress("importing", "frames", true);
    ImportSummary summary = importRecording(goproImporter(), options_, progress);
    const auto events = readEvents(options_.log);
    frames_ = messagesOn<image_t>(events, "CAMERA");
    imu_ = messagesOn<ins_t>(events, "IMU");
    return summary;
  }
  static bool says(const ImportSummary& summary, const std::string& text) {
    return std::any_of(summary.warnings.begin(), summary.warnings.end(),
                       [&](const std::string& line) { return line.find(text) != std::string::npos; });
  }
  ScratchFolder folder_;
  TestVideo video_;
  ImportOptions options_;
  std::vector<image_t> frames_;
  std::vector<ins_t> imu_;
};

TEST_F(GoproFileTest, AnEditListMovesTheMotionTrackWithTheVideo) {
  for (const double start_s : {0.0, -0.4}) {
    video_.track = packets(3);
    video_.track_start_s = start_s;
    writeTestVideo(options_.source, video_);
    import();
    ASSERT_EQ(imu_.size(), 1200u);
    EXPECT_EQ(frames_.at(0).utime, 0);
    const double first_s = 1e-6 * static_cast<double>(imu_[0].utime);
    std::cout << "track from " << start_s << " s: first sample at " << first_s << " s\n";
    EXPECT_NEAR(first_s, start_s, 0.005);
    EXPECT_NEAR(1e-6 * static_cast<double>(imu_[1199].utime), start_s + 1199.0 / 400, 0.005);
  }
}

TEST_F(GoproFileTest, AFewMillisecondsOfAnEditListCount) {
  for (const double video_s : {0.0, -0.005, -0.013, -0.1}) {
    for (const double track_s : {0.005, -0.005, -0.105}) {
      video_.track = packets(3);
      video_.start_s = video_s;
      video_.track_start_s = track_s;
      writeTestVideo(options_.source, video_);
      import();
      ASSERT_EQ(imu_.size(), 1200u);
      const double shift_us = static_cast<double>(imu_[0].utime) - 1e6 * track_s;
      double worst_us = std::abs(shift_us);
      for (const image_t& frame : frames_) {
        const auto grey = decodeGrey(frame);
        ASSERT_TRUE(grey);
        const double true_us = 40'000.0 * numberShownIn(*grey) + 1e6 * video_s;
        worst_us = std::max(worst_us, std::abs(static_cast<double>(frame.utime) - true_us));
      }
      std::cout << "video from " << video_s << " s, track from " << track_s << " s: " << frames_.size()
                << " frames, off by " << worst_us << " us\n";
      EXPECT_LT(worst_us, 500) << video_s << " " << track_s;
      EXPECT_GE(frames_.size(), 47u);
    }
  }
}

TEST_F(GoproFileTest, WhatWasCutOutLeavesAHole) {
  video_.track = packets(2);
  video_.key_every = 10;
  for (const int b_frames : {0, 2}) {
    video_.b_frames = b_frames;
    writeTestVideo(options_.source, video_);
    // Of the encoder's clock, on which the first frame is shown after those that refer to it.
    const double first_s = 0.04 * b_frames;
    setEdits(options_.source, {{0.4, first_s + 0.013}, {0.6, first_s + 1}});
    import();
    ASSERT_EQ(frames_.size(), 25u);
    for (size_t i = 0; i < frames_.size(); ++i) {
      const auto grey = decodeGrey(frames_[i]);
      ASSERT_TRUE(grey);
      const int shown = static_cast<int>(i < 10 ? 1 + i : 15 + i);
      EXPECT_EQ(numberShownIn(*grey), shown);
      EXPECT_NEAR(static_cast<double>(frames_[i].utime), 40'000 * shown - 13'000, 100) << shown;
    }
    EXPECT_EQ(imu_[0].utime, 0);
  }
}

/// One payload a second with a changing or a constant orientation of the image against the camera.
std::vector<DataPacket> withImageOrientation(bool changes) {
  std::vector<DataPacket> all = packets(2);
  for (size_t k = 0; k < all.size(); ++k) {
    const double angle = changes ? 0.02 * static_cast<double>(k) : 0.3;  // rad
    const Bytes q = shorts(
        {static_cast<int>(32767 * std::cos(angle / 2)), 0, 0, static_cast<int>(32767 * std::sin(angle / 2))});
    Bytes inside = record("SCAL", 's', 2, 1, shorts({32767}));
    append(inside, record("IORI", 's', 8, 1, q));
    append(all[k].bytes, container("DEVC", container("STRM", inside)));
  }
  return all;
}

TEST_F(GoproFileTest, AStabilisedVideosOwnTrackBecomesGimbal) {
  video_.track = withImageOrientation(true);
  writeTestVideo(options_.source, video_);
  const ImportSummary summary = import();
  EXPECT_EQ(imu_.size(), 800u);
  EXPECT_TRUE(summary.vehicle.has_imu);
  EXPECT_TRUE(summary.vehicle.mount_sigma_deg);
  const auto turns = messagesOn<gimbal_t>(readEvents(options_.log), "GIMBAL");
  ASSERT_EQ(turns.size(), 2u);
  EXPECT_EQ(turns[1].utime, 1'000'000);
  EXPECT_EQ(turns[1].has_body, 1);
  // The image is turned to the right about the optical axis, I's x: so its axes turn back to the camera's.
  EXPECT_NEAR(turns[1].quat_body[0], std::cos(0.01), 1e-4);
  EXPECT_NEAR(turns[1].quat_body[1], -std::sin(0.01), 1e-4);
  EXPECT_TRUE(says(summary, "turned its images by up to 1.1 degrees")) << summary.warnings[0];
  EXPECT_EQ(frames_.size(), 50u);
}

TEST_F(GoproFileTest, AnImageThatKeepsItsOrientationKeepsTheImu) {
  video_.track = withImageOrientation(false);
  writeTestVideo(options_.source, video_);
  EXPECT_FALSE(import().vehicle.mount_sigma_deg);
  EXPECT_EQ(imu_.size(), 800u);
  EXPECT_TRUE(messagesOn<gimbal_t>(readEvents(options_.log), "GIMBAL").empty());
}

TEST_F(GoproFileTest, TheImuOfATimeLapseIsLeftOut) {
  for (const bool stamped : {true, false}) {
    video_.track.clear();
    for (int k = 0; k < 48; ++k) {  // a sample for each frame, two a second by the recorder's clock
      const auto stamp = record("STMP", 'J', 8, 1, bigEndian(static_cast<uint64_t>(500'000 * k), 8));
      video_.track.push_back({k / 24.0, 1 / 24.0, payload(k, 2, "rad/s", stamped ? stamp : Bytes{})});
    }
    writeTestVideo(options_.source, video_);
    const ImportSummary summary = import();
    EXPECT_TRUE(imu_.empty());
    EXPECT_TRUE(
        says(summary, stamped ? "a second of the video is 12 s of the motion track" : "its gyro has 48 Hz"))
        << summary.warnings[0];
  }
}

TEST_F(GoproFileTest, ChaptersAreOneFlight) {
  video_.frames = 25;
  video_.track = packets(1);
  writeTestVideo(options_.source, video_);
  writeTestVideo(folder_ / "GX020007.MP4", video_);
  options_.further_sources = {options_.source};  // given in the wrong order
  options_.source = folder_ / "GX020007.MP4";
  import();
  ASSERT_EQ(frames_.size(), 50u);
  for (size_t k = 0; k < frames_.size(); ++k) EXPECT_EQ(frames_[k].utime, 40'000 * static_cast<int64_t>(k));
  ASSERT_EQ(imu_.size(), 800u);
  for (size_t k = 0; k < imu_.size(); ++k)
    EXPECT_NEAR(static_cast<double>(imu_[k].utime), 2500.0 * static_cast<double>(k), 2);
  writeTestVideo(folder_ / "GX010008.MP4", video_);
  options_.further_sources = {folder_ / "GX010008.MP4"};
  EXPECT_NE(errorMessageOf([&] { import(); }).find("GX010008.MP4: is no chapter of recording 0007"),
            std::string::npos);
}

TEST_F(GoproFileTest, AChapterThatIsMissingOrThereTwiceIsNotPassedOver) {
  video_.frames = 25;
  video_.track = packets(1);
  const fs::path copies = folder_ / "copies";
  fs::create_directory(copies);
  for (const fs::path& file : {options_.source, folder_ / "GX030007.MP4", copies / "GX010007.MP4"})
    writeTestVideo(file, video_);
  const auto errorWith = [&](const fs::path& further) {
    options_.further_sources = {further};
    return errorMessageOf([&] { import(); });
  };
  EXPECT_NE(errorWith(folder_ / "GX030007.MP4")
                .find("GX030007.MP4: chapter 2 of recording 0007 is missing before it"),
            std::string::npos);
  EXPECT_NE(errorWith(copies / "GX010007.MP4").find("is chapter 1 of recording 0007, as "),
            std::string::npos);
  EXPECT_NE(errorWith(options_.source).find("GX010007.MP4: is given twice"), std::string::npos);
  EXPECT_FALSE(fs::exists(options_.log));
}

/// A HERO5 or older names the first chapter otherwise than the rest.
TEST_F(GoproFileTest, ChaptersOfOlderCamerasAreInOrder) {
  video_.track = packets(1);
  const std::pair<const char*, int> lengths[] = {
      {"GOPR0007.MP4", 10}, {"GP010007.MP4", 25}, {"GP020007.MP4", 20}};
  for (const auto& [name, frames] : lengths) {
    video_.frames = frames;
    writeTestVideo(folder_ / name, video_);
  }
  options_.source = folder_ / "GP020007.MP4";
  options_.further_sources = {folder_ / "GP010007.MP4", folder_ / "GOPR0007.MP4"};
  import();
  ASSERT_EQ(frames_.size(), 55u);
  EXPECT_EQ(numberShownIn(*decodeGrey(frames_[9])), 9);
  EXPECT_EQ(numberShownIn(*decodeGrey(frames_[10])), 0);
  EXPECT_EQ(numberShownIn(*decodeGrey(frames_[34])), 24);
}

TEST_F(GoproFileTest, AVideoThatIsTurnedTurnsTheMounting) {
  video_.rotation_deg = 180;
  video_.track = packets(2);
  writeTestVideo(options_.source, video_);
  const ImportSummary summary = import();
  // Upside down the camera's x is to the left (y of I), its y up (z of I).
  ASSERT_TRUE(summary.vehicle.R_CI);
  Eigen::Matrix3d R_CI;
  R_CI << 0, 1, 0, 0, 0, 1, 1, 0, 0;
  EXPECT_EQ(*summary.vehicle.R_CI, R_CI);
}

TEST_F(GoproFileTest, RecordedCases) {
  if (!sharedCase("gopro_editlist.mp4")) GTEST_SKIP() << "the cases are not here (REDBEE_SHARED)";
  options_.source = *sharedCase("gopro_editlist.mp4");
  import();
  ASSERT_EQ(imu_.size(), 960u);
  EXPECT_NEAR(1e-6 * static_cast<double>(imu_[0].utime), -0.4, 0.005);
  options_.source = *sharedCase("gopro_max_stabilised.mp4");
  EXPECT_TRUE(says(import(), "turned its images by up to 4.7 degrees"));
  options_.source = *sharedCase("gopro_timelapse_hero11.mp4");
  EXPECT_TRUE(says(import(), "a second of the video is 12 s of the motion track"));
}

}  // namespace
}  // namespace redbee::test
