// Bags written by ROS's own Python library (make_bag.py).
#include <cstdlib>
#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "processes/redbee/rosbag/import_rosbag.hpp"
#include "redbee/altimeter_t.hpp"
#include "redbee/bus/image.hpp"
#include "redbee/image_t.hpp"
#include "redbee/ins_t.hpp"
#include "tests/support/log_events.hpp"
#include "tests/support/scratch_folder.hpp"

namespace redbee::test {
namespace {

constexpr int kFrames = 20;
constexpr int kImuSamples = 208;
constexpr int64_t kStart_us = 1'500'000'000'000'000;
constexpr int kWidth = 32, kHeight = 24;

uint8_t pixelOf(int k, int x, int y, int channel = 0) {
  return static_cast<uint8_t>((k + x + 2 * y + 40 * channel) % 256);
}

class RosbagTest : public testing::Test {
 protected:
  RosbagTest() {
    options_ = rosbagImporter().defaults;
    options_.source = folder_ / "f.bag";
    options_.log = folder_ / "f.lcm";
  }
  void SetUp() override {
    if (std::system("/usr/bin/python3 -c 'import rosbag, sensor_msgs.msg' 2>/dev/null") != 0)
      GTEST_SKIP() << "no rosbag for Python: scripts/setup scripts/packages-rosbag.txt installs it";
  }
  void make(const std::string& kind, const std::string& compression = "none", const std::string& jpeg = "") {
    const std::string command = "/usr/bin/python3 " REDBEE_SOURCE_DIR "/tests/rosbag/make_bag.py " +
                                options_.source.string() + " " + kind + " " + compression + " " + jpeg;
    ASSERT_EQ(std::system(command.c_str()), 0);
  }
  ImportSummary import() const {
    Progress progress("importing", "frames", true);
    return importRecording(rosbagImporter(), options_, progress);
  }
  std::string errorMessage() const {
    std::string line = errorMessageOf([&] { import(); });
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    EXPECT_EQ(line.rfind(options_.source.string(), 0), 0u) << line;
    EXPECT_FALSE(fs::exists(options_.log));
    return line;
  }
  void expectError(const std::string& part) const {
    const std::string line = errorMessage();
    EXPECT_NE(line.find(part), std::string::npos) << line;
  }
  static void expectWarning(const ImportSummary& summary, const std::string& part) {
    const auto& all = summary.warnings;
    EXPECT_TRUE(std::any_of(all.begin(), all.end(),
                            [&](const std::string& line) { return line.find(part) != std::string::npos; }))
        << part << " is not among " << testing::PrintToString(all);
  }
  std::vector<image_t> frames() const { return messagesOn<image_t>(readEvents(options_.log), "CAMERA"); }

  void expectPlainFlight() const {
    const auto images = frames();
    ASSERT_EQ(images.size(), static_cast<size_t>(kFrames));
    for (int k = 0; k < kFrames; ++k) {
      const image_t& image = images[static_cast<size_t>(k)];
      EXPECT_EQ(image.utime, kStart_us + 50'000 * k);
      EXPECT_EQ(image.pixelformat, image_t::GRAY);
      const auto grey = decodeGrey(image);
      ASSERT_TRUE(grey);
      EXPECT_EQ((*grey)(3, 5), pixelOf(k, 5, 3));
      EXPECT_EQ((*grey)(kHeight - 1, kWidth - 1), pixelOf(k, kWidth - 1, kHeight - 1));
    }
  }

  ScratchFolder folder_;
  ImportOptions options_;
};

class RosbagCompression : public RosbagTest, public testing::WithParamInterface<std::string> {};

TEST_P(RosbagCompression, EveryMessageComesInAtItsStamp) {
  make("plain", GetParam());
  const ImportSummary summary = import();
  expectPlainFlight();
  const auto events = readEvents(options_.log);
  EXPECT_TRUE(isSortedByTime(events));
  const auto imu = messagesOn<ins_t>(events, "IMU");
  ASSERT_EQ(imu.size(), static_cast<size_t>(kImuSamples));
  for (size_t k = 0; k < imu.size(); ++k) {
    EXPECT_EQ(imu[k].utime, kStart_us - 20'000 + 5'000 * static_cast<int64_t>(k));
    EXPECT_DOUBLE_EQ(imu[k].gyro[2], -0.001 * static_cast<double>(k % 7));
    EXPECT_DOUBLE_EQ(imu[k].accel[1], 0.02 * static_cast<double>(k % 4));
  }
  const auto heights = messagesOn<altimeter_t>(events, "ALTIMETER");
  ASSERT_EQ(heights.size(), static_cast<size_t>(kFrames - 1));  // one is infinite
  EXPECT_FLOAT_EQ(static_cast<float>(heights[3].height), 5.3F);
  expectWarning(summary, "/altimeter: 1 of 20 ranges");
}

INSTANTIATE_TEST_SUITE_P(All, RosbagCompression, testing::Values("none", "bz2", "lz4"),
                         [](const auto& compression) { return compression.param; });

TEST_F(RosbagTest, TheVehicleIsWhatTheBagStates) {
  make("plain");
  const VehicleDescription vehicle = import().vehicle;
  ASSERT_TRUE(vehicle.intrinsics);
  EXPECT_EQ(vehicle.intrinsics->model, "radtan");
  EXPECT_DOUBLE_EQ(vehicle.intrinsics->fy, 31);
  EXPECT_DOUBLE_EQ(vehicle.intrinsics->cx, 15.5);
  EXPECT_EQ(vehicle.intrinsics->distortion, (std::vector<double>{0.1, -0.02, 0.001, 0.002, 0}));
  ASSERT_TRUE(vehicle.start_height);
  EXPECT_DOUBLE_EQ(vehicle.start_height->height_m, 5);
  EXPECT_TRUE(vehicle.has_imu);
}

TEST_F(RosbagTest, OfARectifiedImageTheProjectionMatrixCounts) {
  make("rectified");
  const auto camera = import().vehicle.intrinsics;
  ASSERT_TRUE(camera);
  EXPECT_DOUBLE_EQ(camera->fx, 28);
  EXPECT_TRUE(
      std::all_of(camera->distortion.begin(), camera->distortion.end(), [](double k) { return k == 0; }));
}

TEST_F(RosbagTest, OfSeveralCamerasOneIsChosen) {
  make("stereo");
  expectError(
      "several topics with images: choose one with --image-topic: /cam0/image_raw (20 sensor_msgs/Image), "
      "/cam1/image_raw (20 sensor_msgs/Image)");
  options_.topics.image = "/cam2/image_raw";
  expectError("holds no images on /cam2/image_raw (--image-topic); it has /cam0/image_raw");
  options_.topics.image = "/cam0/image_raw";
  EXPECT_EQ(import().vehicle.intrinsics->fx, 30);  // camera_info of its own namespace
  expectPlainFlight();
}

TEST_F(RosbagTest, ATopicCanBeLeftOut) {
  make("plain");
  options_.topics.imu = "none";
  options_.topics.camera_info = "none";
  const ImportSummary summary = import();
  EXPECT_EQ(summary.imu_samples, 0);
  expectWarning(summary, "px are assumed");
}

TEST_F(RosbagTest, JpegsAreCopiedUnchanged) {
  const std::string jpeg = folder_ / "image.jpg";
  cv::imwrite(jpeg, texture(kWidth, kHeight, 0, 3));
  make("compressed", "lz4", jpeg);
  import();
  const auto images = frames();
  ASSERT_EQ(images.size(), static_cast<size_t>(kFrames));
  const std::string bytes = readText(jpeg);
  EXPECT_EQ(std::string(images[7].data.begin(), images[7].data.end()), bytes);
  EXPECT_EQ(images[7].width, kWidth);
  writeText(jpeg, bytes.substr(0, bytes.size() - 20));
  make("compressed", "none", jpeg);
  fs::remove(options_.log);
  expectError("/cam0/image_raw/compressed, message 1: JPEG is cut short");
}

TEST_F(RosbagTest, SixteenBitsAreScaledByTheSequencesRange) {
  for (const std::string kind : {"mono16", "mono16_big"}) {
    make(kind);
    import();
    // 1000 at the left of the first image to 3210 at the right of the last.
    const auto images = frames();
    ASSERT_EQ(images.size(), static_cast<size_t>(kFrames));
    for (const int k : {0, 9, 19}) {
      const auto grey = decodeGrey(images[static_cast<size_t>(k)]);
      ASSERT_TRUE(grey);
      const double value = 1000 + 10 * 5 + 100 * k;
      EXPECT_NEAR((*grey)(2, 5), 255 * (value - 1000) / 2210, 3) << kind;
    }
  }
}

TEST_F(RosbagTest, ColoursKeepTheirOrder) {
  make("rgb8");
  import();
  const auto images = frames();
  ASSERT_EQ(images.size(), static_cast<size_t>(kFrames));
  EXPECT_EQ(images[0].pixelformat, image_t::MJPEG);
  const auto colour = decodeColour(images[0]);
  ASSERT_TRUE(colour);
  const cv::Scalar mean = cv::mean(*colour);  // red is 80 below blue
  EXPECT_NEAR(mean[0] - mean[2], 80, 3);
}

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
  expectWarning(repeated, "1 of 20 images do not come after the one before");
}

TEST_F(RosbagTest, ADamagedImageIsPassedOverWhereThatIsWanted) {
  make("short_image");
  expectError("/cam0/image_raw, message 7: has 3 bytes of pixels, not 24 rows of 32");
  options_.keep_going = true;
  const ImportSummary summary = import();
  EXPECT_EQ(summary.frames, kFrames - 1);
  expectWarning(summary, "1 of 20 images are damaged and left out");
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
  writeText(options_.source, "SQLite format 3");
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
