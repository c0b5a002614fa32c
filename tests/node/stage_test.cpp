#include "redbee/node/stage.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "redbee/bus/image.hpp"
#include "redbee/detections_t.hpp"
#include "redbee/image_t.hpp"
#include "redbee/node/image_stage.hpp"

namespace redbee::test {
namespace {

constexpr int64_t kPeriod = 40'000;

/// For each image one DETECTIONS message, with the ALTIMETER message of the same time.
class EchoStage : public ImageStage<altimeter_t> {
 public:
  explicit EchoStage(Bus& bus)
      : ImageStage(bus, "echo", "hash", "CAMERA", {64, 48}, std::chrono::milliseconds(200), true) {
    on<altimeter_t>("ALTIMETER", [this](const altimeter_t& m) {
      if (m.height < 0) return false;
      companions().put(timeOf(m), m, now());
      return true;
    });
  }
  int resets = 0;
  std::vector<int64_t> left_out;  ///< frames
  std::vector<double> heights;    ///< -1 where a frame had no altitude

 private:
  void work(const image_t& image) override {
    const altimeter_t* altitude = companions().find(timeOf(image));
    heights.push_back(altitude != nullptr ? altitude->height : -1);
    noteResultReady();
    publish("DETECTIONS", detections_t{});
    companions().eraseThrough(timeOf(image));
  }
  void noteLeftOut(CameraTime frame) override { left_out.push_back(toUtime(frame) / kPeriod - 1000); }
  void reset(CameraTime) override { ++resets; }
};

class StageTest : public testing::Test {
 protected:
  void publishImage(int64_t k) {
    image_t image{};
    image.utime = (k + 1000) * kPeriod;
    image.width = 64;
    image.height = 48;
    bus_->publish("CAMERA", image);
  }
  void publishAltitude(int64_t k, double height) {
    bus_->publish("ALTIMETER", altimeter_t{(k + 1000) * kPeriod, height, 0.1});
  }
  void settle() {
    do {
      if (stage_) stage_->process();
    } while (bus_->handle(std::chrono::milliseconds(0)) > 0);
  }

  std::unique_ptr<Bus> bus_ = makeLcmBus("memq://");
  std::unique_ptr<EchoStage> stage_ = std::make_unique<EchoStage>(*bus_);
  std::vector<detections_t> published_;
  Subscription subscription_ = bus_->subscribe<detections_t>(
      "DETECTIONS", 64, [this](const detections_t& m) { published_.push_back(m); });
};

TEST_F(StageTest, FillsInTimeAndSequenceOfWhatItPublishes) {
  for (int k = 0; k < 3; ++k) {
    publishAltitude(k, 1 + k);
    publishImage(k);
    settle();
  }
  ASSERT_EQ(published_.size(), 3U);
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(published_[static_cast<size_t>(k)].utime, (k + 1000) * kPeriod);
    EXPECT_EQ(published_[static_cast<size_t>(k)].sequence, k);
  }
  EXPECT_EQ(stage_->heights, (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(stage_->health().published(), 3);
}

TEST_F(StageTest, WaitsForACompanionUntilTheLastMessage) {
  publishImage(0);
  settle();
  EXPECT_TRUE(published_.empty());
  for (int k = 1; k <= 2; ++k) publishImage(k);
  settle();
  EXPECT_TRUE(published_.empty());
  stage_->finish();
  EXPECT_EQ(stage_->heights, (std::vector<double>{-1, -1, -1}))
      << "after the last message nothing is pending";
  EXPECT_EQ(stage_->health().late(), 0);
}

TEST_F(StageTest, SkipsWhatIsOlderThanItsWaitAndTellsInOrder) {
  for (int k = 0; k < 10; ++k) {
    publishAltitude(k, k);
    publishImage(k);
  }
  bus_->handle(std::chrono::milliseconds(0));
  settle();
  EXPECT_EQ(stage_->heights, (std::vector<double>{4, 5, 6, 7, 8, 9})) << "of the last 200 ms";
  EXPECT_EQ(stage_->health().skipped(), 4);
  EXPECT_EQ(stage_->left_out, (std::vector<int64_t>{0, 1, 2, 3}));
}

TEST_F(StageTest, SkipsNothingThatHasWaitedForOthers) {
  for (int k = 0; k < 6; ++k) {
    publishImage(k);
    settle();
  }
  EXPECT_TRUE(stage_->heights.empty());
  for (int k = 6; k < 9; ++k) publishImage(k);
  bus_->handle(std::chrono::milliseconds(0));
  settle();
  EXPECT_EQ(stage_->heights.size(), 9U) << "the companion of the first frame timed out";
  EXPECT_EQ(stage_->health().skipped(), 0);
}

TEST_F(StageTest, SkipsNoFrameThatWasHeldUntilItWasBelieved) {
  for (int k = 0; k < 10; ++k) {
    publishAltitude(k, k);
    publishImage(k);
    settle();
  }
  for (int k = 300; k < 325; k += 5) {
    publishAltitude(k, k);
    publishImage(k);
    settle();
  }
  EXPECT_EQ(stage_->heights.size(), 15U) << "five at once, 0.8 s from first to last";
  EXPECT_EQ(stage_->health().skipped(), 0);
}

TEST_F(StageTest, ACameraSlowerThanTheWaitIsNoBacklog) {
  for (int k = 0; k < 40; k += 10) {
    publishImage(k);
    publishImage(k + 10);
    settle();
  }
  EXPECT_EQ(stage_->health().skipped(), 0);
}

TEST_F(StageTest, CountsWhatIsDamagedOrImplausible) {
  bus_->publish("ALTIMETER", std::vector<uint8_t>{1, 2, 3});
  publishAltitude(0, -1);
  settle();
  EXPECT_EQ(stage_->health().damaged(), 2);
}

TEST_F(StageTest, ForgetsWhatWaitsWhereTheCamerasClockWasSetBack) {
  publishImage(500);
  settle();
  for (int k = 0; k < 5; ++k) publishImage(k);
  settle();
  for (int k = 0; k < 5; ++k) publishAltitude(k, 7);
  settle();
  EXPECT_EQ(stage_->resets, 1);
  EXPECT_EQ(stage_->heights, (std::vector<double>{7, 7, 7, 7, 7}));
}

TEST_F(StageTest, PutsImagesInOrder) {
  for (const int k : {0, 1, 2, 3, 4, 5, 6, 8, 7, 10, 9, 11}) {
    publishAltitude(k, k);
    publishImage(k);
    settle();
  }
  EXPECT_EQ(stage_->heights, (std::vector<double>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}));
  EXPECT_EQ(stage_->health().skipped(), 0);
}

TEST_F(StageTest, NamesASecondSourceOnAChannel) {
  for (int k = 0; k < 12; ++k) {
    publishAltitude(k, k);
    publishImage(k);
    publishImage(k - 900);
    settle();
  }
  EXPECT_EQ(stage_->heights.size(), 12U);
  EXPECT_EQ(stage_->resets, 0);
  const process_health_t health = stage_->health().nextMessage();
  EXPECT_EQ(health.message, "CAMERA: a second source is ignored");
}

TEST_F(StageTest, IgnoresImagesThatAreNotOfTheCamerasSizeByMessageOrHeader) {
  for (int k = 0; k < 8; ++k) {
    publishAltitude(k, k);
    publishImage(k);
    image_t large = jpegMessage((k + 1000) * kPeriod + 20'000, cv::Mat1b(480, 640, uchar{7}), 80);
    if (k % 2 == 0) large.width = 64;
    if (k % 2 == 0) large.height = 48;
    bus_->publish("CAMERA", large);
    settle();
  }
  EXPECT_EQ(stage_->heights, (std::vector<double>{0, 1, 2, 3, 4, 5, 6, 7}));
  EXPECT_EQ(stage_->health().nextMessage().message,
            "CAMERA: an image of 640x480 is ignored, configured are 64x48");
}

TEST_F(StageTest, ReceivesNothingAfterItsEnd) {
  publishAltitude(0, 1);
  publishImage(0);
  stage_.reset();
  settle();
  EXPECT_TRUE(published_.empty());
}

}  // namespace
}  // namespace redbee::test
