// redbee-camera on a simulated source: what it publishes, what its health says, when it opens its source
// again.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/videodev2.h>

#include <deque>
#include <optional>
#include <utility>

#include "processes/camera/node.hpp"
#include "processes/camera/v4l2_exposure.hpp"
#include "redbee/bus/image.hpp"
#include "tests/support/camera.hpp"

namespace redbee::test {
namespace {

using testing::HasSubstr;

struct Camera {
  int64_t now_ns = 1'000'000'000;
  std::string open_fault;
  std::string fault;  ///< with which it ends, once its images are taken
  bool is_open = false;
  int opened = 0;
  std::deque<image_t> images;
  std::optional<double> exposure_s;
  std::string time_fault;
};

class SimulatedSource : public FrameSource {
 public:
  explicit SimulatedSource(Camera& camera) : camera_(camera) {}
  std::string open() override {
    ++camera_.opened;
    camera_.is_open = camera_.open_fault.empty();
    return camera_.open_fault;
  }
  bool isOpen() const override { return camera_.is_open; }
  std::optional<image_t> next(std::chrono::milliseconds) override {
    if (camera_.images.empty()) {
      if (!camera_.fault.empty()) camera_.is_open = false;
      return std::nullopt;
    }
    image_t image = camera_.images.front();
    camera_.images.pop_front();
    return image;
  }
  std::string fault() const override { return camera_.fault; }
  std::string timeFault() const override { return camera_.time_fault; }
  std::optional<double> exposure_s() const override { return camera_.exposure_s; }

 private:
  Camera& camera_;
};

class CameraNodeTest : public testing::Test {
 protected:
  void start(int jpeg_quality = 0) {
    CaptureParameters capture;
    capture.jpeg_quality = jpeg_quality;
    start(capture);
  }
  void start(const CaptureParameters& capture) {
    Configuration configuration;
    configuration.camera = intrinsics();
    configuration.camera.width = 64;
    configuration.camera.height = 48;
    configuration.camera.line_delay_s = line_delay_s_;
    configuration.capture = capture;
    node_ = std::make_unique<CameraNode>(*bus_, configuration, std::make_unique<SimulatedSource>(camera_),
                                         [this] { return camera_.now_ns; });
    subscription_ =
        bus_->subscribe<image_t>("CAMERA", 100, [this](const image_t& m) { published_.push_back(m); });
  }
  void run(int passes) {
    for (int i = 0; i < passes; ++i) node_->processNext();
    bus_->handle(std::chrono::milliseconds(0));
  }
  static cv::Mat1b picture(int k) {
    cv::Mat1b image(48, 64);
    for (int y = 0; y < image.rows; ++y) {
      for (int x = 0; x < image.cols; ++x) image(y, x) = static_cast<uint8_t>(2 * x + y + k);
    }
    return image;
  }
  process_health_t health() { return node_->health().nextMessage(); }

  std::unique_ptr<Bus> bus_ = makeLcmBus("memq://");
  Camera camera_;
  double line_delay_s_ = 0;
  std::unique_ptr<CameraNode> node_;
  Subscription subscription_;
  std::vector<image_t> published_;
};

TEST_F(CameraNodeTest, PublishesWhatComesAsItComes) {
  start();
  camera_.images = {rawGreyMessage(100, picture(0)), jpegMessage(200, picture(1), 90)};
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
  camera_.images = {rawGreyMessage(100, picture(0))};
  run(1);
  ASSERT_EQ(published_.size(), 1U);
  EXPECT_EQ(published_[0].pixelformat, image_t::MJPEG);
  const auto decoded = decodeGrey(published_[0]);
  ASSERT_TRUE(decoded);
  EXPECT_LT(cv::norm(*decoded, picture(0), cv::NORM_INF), 8);
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
  camera_.images = {rawGreyMessage(200, picture(0)), rawGreyMessage(200, picture(1)),
                    rawGreyMessage(150, picture(2)), rawGreyMessage(300, picture(3))};
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
    camera_.images = {rawGreyMessage(100'000, picture(0))};
    run(1);
    camera_.exposure_s = 0.008;
    camera_.images = {rawGreyMessage(140'000, picture(1))};
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
  camera_.images = {rawGreyMessage(100'000, picture(0))};
  run(1);
  EXPECT_THAT(health().message,
              HasSubstr("does not tell the exposure time, and capture.exposure_s is not set"));
  capture.exposure_s = 0.01;
  start(capture);
  camera_.images = {rawGreyMessage(200'000, picture(0))};
  run(1);
  EXPECT_EQ(published_.back().utime, 195'000);
  EXPECT_EQ(health().state, process_health_t::GOOD);
}

TEST_F(CameraNodeTest, ImagesWithDoubtfulTimesArePublishedAndTheDoubtIsSaid) {
  start();
  camera_.images = {rawGreyMessage(100, picture(0)), rawGreyMessage(200, picture(1))};
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

TEST_F(CameraNodeTest, OpensASourceThatEndsAgainLessAndLessOften) {
  start();
  camera_.open_fault = "no such device";
  node_->processNext();
  EXPECT_EQ(health().message, "no such device");
  const auto pass = [&](int64_t ms) {
    camera_.now_ns += ms * 1'000'000;
    node_->processNext();
  };
  pass(50);
  EXPECT_EQ(camera_.opened, 1);
  pass(50);
  EXPECT_EQ(camera_.opened, 2);
  pass(150);
  EXPECT_EQ(camera_.opened, 2);
  camera_.open_fault.clear();
  camera_.fault = "the pipeline has ended";
  camera_.images = {rawGreyMessage(100, picture(0))};
  pass(50);
  EXPECT_EQ(camera_.opened, 3);
  EXPECT_EQ(health().state, process_health_t::GOOD);
  node_->processNext();
  EXPECT_EQ(health().message, "the pipeline has ended");
  pass(100);  // an image came: from the shortest pause again
  EXPECT_EQ(camera_.opened, 4);
}

}  // namespace
}  // namespace redbee::test
