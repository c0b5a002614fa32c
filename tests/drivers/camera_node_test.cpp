// redbee-camera on a simulated source: what it publishes, what its health says.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/videodev2.h>

#include <optional>
#include <string>
#include <utility>

#include "processes/camera/v4l2_exposure.hpp"
#include "tests/drivers/camera_node_fixture.hpp"

namespace redbee::test {
namespace {

using testing::HasSubstr;

TEST_F(CameraNodeTest, PublishesWhatComesAsItComes) {
  start();
  camera_.images = {rawGreyMessage(100, testImage(0)), jpegMessage(200, testImage(1), 90)};
  const auto sent = camera_.images;
  run(3);
  ASSERT_EQ(published_.size(), 2U);
  for (size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(published_[i].utime, sent[i].utime);
    EXPECT_EQ(published_[i].pixelformat, sent[i].pixelformat);
    EXPECT_EQ(published_[i].data, sent[i].data);
  }
  EXPECT_EQ(health().state, process_health_t::GOOD);
}

TEST_F(CameraNodeTest, CompressesRawImagesWhereItIsToldTo) {
  start(95);
  camera_.images = {rawGreyMessage(100, testImage(0))};
  run(1);
  ASSERT_EQ(published_.size(), 1U);
  EXPECT_EQ(published_[0].pixelformat, image_t::MJPEG);
  const auto decoded = decodeGrey(published_[0]);
  ASSERT_TRUE(decoded);
  EXPECT_LT(cv::norm(*decoded, testImage(0), cv::NORM_INF), 8);
}

TEST_F(CameraNodeTest, AnotherSizeIsNoImage) {
  start();
  camera_.images = {rawGreyMessage(100, cv::Mat1b(24, 32, uint8_t{9}))};
  run(1);
  EXPECT_TRUE(published_.empty());
  EXPECT_EQ(health().damaged, 1);
  EXPECT_THAT(health().message, HasSubstr("images of 32x24, configured are 64x48"));
}

TEST_F(CameraNodeTest, TimesIncrease) {
  start();
  camera_.images = {rawGreyMessage(200, testImage(0)), rawGreyMessage(200, testImage(1)),
                    rawGreyMessage(150, testImage(2)), rawGreyMessage(300, testImage(3))};
  run(4);
  ASSERT_EQ(published_.size(), 2U);
  EXPECT_EQ(published_[1].utime, 300);
  EXPECT_EQ(health().skipped, 2);
}

/// Of 48 rows of 100 us, exposed for 4 ms, then for 8 ms.
TEST_F(CameraNodeTest, StampsTheMiddleOfTheExposureWhereTheDriverTellsIt) {
  constexpr int64_t kHalfReadout_us = 2350;
  for (const auto& [stamp, sign] :
       {std::pair<std::string, int64_t>{"exposure_start", 1}, {"readout_end", -1}}) {
    published_.clear();
    line_delay_s_ = 1e-4;
    CaptureParameters capture;
    capture.stamp = stamp;
    start(capture);
    camera_.exposure_s = 0.004;
    camera_.images = {rawGreyMessage(100'000, testImage(0))};
    run(1);
    camera_.exposure_s = 0.008;
    camera_.images = {rawGreyMessage(140'000, testImage(1))};
    run(1);
    ASSERT_EQ(published_.size(), 2U);
    EXPECT_EQ(published_[0].utime, 100'000 + sign * (2000 + kHalfReadout_us)) << stamp;
    EXPECT_EQ(published_[1].utime, 140'000 + sign * (4000 + kHalfReadout_us)) << stamp;
    EXPECT_EQ(health().state, process_health_t::GOOD);
  }
}

TEST_F(CameraNodeTest, AnExposureThatIsNotToldIsTheConfiguredOneOrMissing) {
  CaptureParameters capture;
  capture.stamp = "readout_end";
  start(capture);
  camera_.images = {rawGreyMessage(100'000, testImage(0))};
  run(1);
  EXPECT_THAT(health().message,
              HasSubstr("does not tell the exposure time, and capture.exposure_s is not set"));
  capture.exposure_s = 0.01;
  start(capture);
  camera_.images = {rawGreyMessage(200'000, testImage(0))};
  run(1);
  EXPECT_EQ(published_.back().utime, 195'000);
  EXPECT_EQ(health().state, process_health_t::GOOD);
}

TEST_F(CameraNodeTest, ImagesWithDoubtfulTimesArePublishedAndTheDoubtIsSaid) {
  start();
  camera_.images = {rawGreyMessage(100, testImage(0)), rawGreyMessage(200, testImage(1))};
  camera_.time_fault = "the sender does not say when";
  run(1);
  EXPECT_EQ(published_.size(), 1U);
  EXPECT_EQ(health().state, process_health_t::DEGRADED);
  EXPECT_THAT(health().message, HasSubstr("the sender does not say when"));
  camera_.time_fault.clear();
  run(1);
  EXPECT_EQ(health().state, process_health_t::GOOD);
}

TEST(V4l2Exposure, IsTheControlsWhereItIsPlausible) {
  const auto with = [](std::optional<int32_t> value) {
    return v4l2Exposure(3, [=](int device, uint32_t control) {
      EXPECT_EQ(device, 3);
      EXPECT_EQ(control, V4L2_CID_EXPOSURE_ABSOLUTE);
      return value;
    });
  };
  EXPECT_NEAR(with(156).value(), 0.0156, 1e-12);
  for (const auto& value : {std::optional<int32_t>(), {0}, {-5}, {20000}}) EXPECT_FALSE(with(value));
  EXPECT_FALSE(v4l2Exposure(-1)) << "no device is open";
  EXPECT_FALSE(v4l2Exposure(0)) << "no camera";
}

}  // namespace
}  // namespace redbee::test
