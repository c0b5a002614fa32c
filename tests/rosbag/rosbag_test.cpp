#include <opencv2/imgcodecs.hpp>

#include "redbee/altimeter_t.hpp"
#include "redbee/ins_t.hpp"
#include "tests/rosbag/bag_fixture.hpp"

namespace redbee::test {
namespace {

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

}  // namespace
}  // namespace redbee::test
