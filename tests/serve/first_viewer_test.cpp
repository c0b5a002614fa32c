// Without viewers neither images nor masks nor homographies are received; the first one sees the next image.
#include "processes/serve/node.hpp"
#include "tests/serve/watched_ground.hpp"

namespace redbee::test {
namespace {

class FirstViewer : public testing::Test {
 protected:
  FirstViewer()
      : configuration_(configuration()),
        mosaic_(configuration_),
        node_(*bus_, configuration_, live_, mosaic_) {}
  static Configuration configuration() {
    Configuration configuration;
    configuration.camera = intrinsics();
    return configuration;
  }
  void publishFrame(int k) {
    bus_->publish(configuration_.channels.camera,
                  rawGreyMessage(utimeOf(k), cv::Mat1b(kHeight, kWidth, uchar{90})));
    detections_t detections{};
    detections.utime = utimeOf(k);
    detections.status = foreground_t::LEARNING;
    bus_->publish(configuration_.channels.detections, detections);
  }
  void pass() {
    while (bus_->handle(std::chrono::milliseconds(0)) > 0) {
    }
    node_.processNext();
  }
  std::shared_ptr<SharedFrame> shown() { return live_.wait({}, std::chrono::milliseconds(0)).frame; }
  int64_t damagedAfterNoise() {
    for (const std::string& channel : {configuration_.channels.camera, configuration_.channels.foreground,
                                       configuration_.channels.fused_homography})
      bus_->publish(channel, std::vector<uint8_t>(1000, 7));
    pass();
    return node_.health().nextMessage().damaged;
  }

  std::unique_ptr<Bus> bus_ = makeLcmBus("memq://");
  Configuration configuration_;
  Live live_;
  LiveMosaic mosaic_;
  ServeNode node_;
};

TEST_F(FirstViewer, SeesTheImageThatComesNext) {
  for (int k = 0; k < 5; ++k) {
    publishFrame(k);
    pass();
  }
  EXPECT_EQ(shown(), nullptr);
  const auto viewer = live_.join();
  pass();  // in which the viewer is seen
  publishFrame(5);
  pass();
  ASSERT_NE(shown(), nullptr);
  EXPECT_EQ(shown()->utime(), utimeOf(5));
  EXPECT_NE(shown()->bundle().find("\"detections\""), std::string::npos);
}

TEST_F(FirstViewer, SeesNothingOfWhatWasShownToOthersBefore) {
  {
    const auto viewer = live_.join();
    pass();
    publishFrame(0);
    pass();
    live_.setHealth("{}");
    live_.setMap("{}");
    ASSERT_NE(shown(), nullptr);
  }
  pass();
  const auto viewer = live_.join();
  const Live::Update update = live_.wait({}, std::chrono::milliseconds(0));
  EXPECT_EQ(update.frame, nullptr);
  EXPECT_EQ(update.health, "");
  EXPECT_EQ(update.map, "");
  pass();
  publishFrame(100);
  pass();
  ASSERT_NE(shown(), nullptr);
  EXPECT_EQ(shown()->utime(), utimeOf(100));
}

// Nothing but a pose has come, and nothing comes any more: a page that is loaded again shows it as the one
// before did.
TEST_F(FirstViewer, SeesTheMapThoughNothingNewComes) {
  pose_t pose{};
  pose.utime = utimeOf(0);
  pose.quat[0] = 1;
  bus_->publish(configuration_.channels.pose, pose);
  const auto map = [this] {
    const auto viewer = live_.join();
    pass();
    return live_.wait({}, std::chrono::milliseconds(0)).map;
  };
  const std::string first = map();
  EXPECT_NE(first, "");
  pass();  // in which it is seen that nobody looks
  EXPECT_EQ(map(), first);
}

TEST_F(FirstViewer, WithoutViewersTheBulkIsNotReceived) {
  EXPECT_EQ(damagedAfterNoise(), 0);
  const auto viewer = live_.join();
  pass();
  EXPECT_EQ(damagedAfterNoise(), 3);
}

}  // namespace
}  // namespace redbee::test
