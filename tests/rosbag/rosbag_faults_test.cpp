#include "tests/rosbag/bag_fixture.hpp"

namespace redbee::test {
namespace {

TEST_F(RosbagTest, WhatIsImplausibleIsRefusedOrSaid) {
  make("imu_in_g");
  expectError("it fits g, give --accel-unit g");
  options_.units.accel = "g";
  EXPECT_EQ(import().imu_samples, kImuSamples);
  fs::remove(options_.log);
  options_.units.accel = "m/s2";
  make("imu_without_gyro");
  expectError("/imu0, message 1: has no angular_velocity");
  make("float");
  expectError("/cam0/image_raw, message 1: has the encoding '32FC1', which is not read");
  make("other_size");
  expectError("/cam0/camera_info is of 640x24 px");
  make("rational");
  expectError("'rational_polynomial' is not supported");
  make("uncalibrated");
  expectWarning(import(), "/cam0/camera_info: the camera is not calibrated");
}

TEST_F(RosbagTest, OrderAndTimesThatAreMissingAreSaid) {
  make("unstamped");
  const ImportSummary unstamped = import();
  expectWarning(unstamped, "/imu0: 208 of 208 messages have no stamp");
  EXPECT_EQ(unstamped.first_utime, kStart_us + 3'000);
  make("imu_out_of_order");
  const ImportSummary sorted = import();
  expectWarning(sorted, "/imu0: messages are not in the order of their stamps");
  expectWarning(sorted, "/imu0: 1 messages repeat the stamp");
  EXPECT_EQ(sorted.imu_samples, kImuSamples - 1);
  make("repeated_image");
  const ImportSummary repeated = import();
  EXPECT_EQ(repeated.frames, kFrames - 1);
  expectWarning(repeated, "/cam0/image_raw: 1 of 20 do not come after the one before");
}

TEST_F(RosbagTest, ADamagedImageIsPassedOverWhereThatIsWanted) {
  make("short_image");
  expectError("/cam0/image_raw, message 7: has 3 bytes of pixels, not 24 rows of 32");
  options_.keep_going = true;
  const ImportSummary summary = import();
  EXPECT_EQ(summary.frames, kFrames - 1);
  expectWarning(summary, "1 of 20 images are damaged and left out");
}

TEST_F(RosbagTest, StampsThatLeapAreLeftOutAndSaid) {
  make("leaping_images");
  const ImportSummary two = import();
  EXPECT_EQ(two.frames, kFrames - 2);
  EXPECT_EQ(two.last_utime, kStart_us + 50'000 * (kFrames - 1));
  expectWarning(two, "/cam0/image_raw: 2 of 20 times leap, the first (number 6) by 315360000.05");
  for (const char* kind : {"leaping_first", "leaping_last"}) {
    make(kind);
    const ImportSummary one = import();
    EXPECT_EQ(one.frames, kFrames - 1) << kind;
    EXPECT_LT(one.last_utime - one.first_utime, 1'000'000) << kind;
    expectWarning(one, "1 of 20 times leap");
  }
  make("leaping_imu");
  const ImportSummary imu = import();
  EXPECT_EQ(imu.imu_samples, kImuSamples - 1);
  EXPECT_EQ(imu.frames, kFrames);
  expectWarning(imu, "/imu0: 1 of 208 times leap");
}

TEST_F(RosbagTest, AClockThatIsSetDuringTheRecordingIsRefused) {
  make("clock_set");
  expectError("/cam0/image_raw: times leap by 315360000 s");
  make("stamps_back");
  expectError("/cam0/image_raw: 10 of 20 times run backwards");
}

TEST_F(RosbagTest, AHandfulOfImuSamplesIsSaid) {
  make("few_imu");
  expectWarning(import(), "the IMU has 8 samples");
}

TEST_F(RosbagTest, ImagesWithoutStampsAreSaid) {
  make("images_unstamped");
  expectWarning(import(), "/cam0/image_raw: 20 of 20 messages have no stamp");
}

TEST_F(RosbagTest, TheRangeOf16BitsIsThatOfTheImagesThatAreWhole) {
  options_.keep_going = true;
  make("mono16_short_first");
  EXPECT_EQ(import().frames, kFrames - 1);
  const auto images = frames();
  // Values from 1100 to 3210 fill the range: the ramp of an image is more than a few steps of grey.
  const auto grey = decodeGrey(images.back());
  ASSERT_TRUE(grey);
  EXPECT_GT((*grey)(0, kWidth - 1), 250);
  const auto first = decodeGrey(images.front());
  ASSERT_TRUE(first);
  EXPECT_LT((*first)(0, 0), 5);
}

TEST_F(RosbagTest, DamagedBagsGiveOneLine) {
  make("plain", "bz2");
  const std::string whole = readText(options_.source);
  writeText(options_.source, whole.substr(0, whole.size() / 2));
  EXPECT_NE(errorMessage().find("rosbag reindex"), std::string::npos);
  writeText(options_.source, "");
  expectError("is no ROS 1 bag");
  writeText(options_.source, "#ROSBAG V2.0\n");
  errorMessage();
  writeText(options_.source, std::string("SQLite format 3\0", 16));
  expectError("is a ROS 2 bag in SQLite");
  std::string broken = whole;
  for (size_t i = 6000; i < 9000; ++i) broken[i] = 'x';  // within the first chunk
  writeText(options_.source, broken);
  expectError("is damaged");
  fs::remove(options_.source);
  expectError("no such file");
}

TEST_F(RosbagTest, ABagThatIsStillBeingWrittenIsNotIndexed) {
  make("plain");
  // rosbag writes the place of the index last: 8 bytes after "index_pos=" in the first record.
  std::string bag = readText(options_.source);
  const size_t at = bag.find("index_pos=");
  ASSERT_NE(at, std::string::npos);
  bag.replace(at + 10, 8, std::string(8, '\0'));
  writeText(options_.source, bag);
  expectError("has no index");
}

}  // namespace
}  // namespace redbee::test
