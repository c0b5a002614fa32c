// More objects than a message may hold: the receivers would refuse it whole.
#include <gtest/gtest.h>

#include "processes/foreground_publisher.hpp"
#include "redbee/bus/image.hpp"
#include "redbee/detections_t.hpp"
#include "redbee/node/message_check.hpp"
#include "redbee/node/message_limits.hpp"

namespace redbee::test {
namespace {

constexpr int kWidth = 64, kHeight = 48;

DetectorOutput outputOf(int detections) {
  DetectorOutput output;
  output.probability = cv::Mat1b::zeros(kHeight, kWidth);
  output.mask = output.probability.clone();
  output.unknown = output.probability.clone();
  for (int i = 0; i < detections; ++i) {
    Detection detection;
    detection.id = i + 1;
    detection.box = {i % 60, i % 40, 3, 3};
    detection.area_px = 9;
    detection.score = i % 2 == 0 ? 0.2F : 0.9F;
    detection.seen = true;
    output.detections.push_back(detection);
  }
  return output;
}

detections_t published(const DetectorOutput& output) {
  const auto bus = makeLcmBus("memq://");
  Configuration configuration;
  configuration.camera = {kWidth, kHeight, 50, 50, 31.5, 23.5, {}};
  detections_t received{};
  const Subscription subscription = bus->subscribe<detections_t>(
      configuration.channels.detections, 10, [&](const detections_t& m) { received = m; });
  Publisher publisher(*bus);
  publisher.beginFrame(CameraTime(fromUtime(1'000'000)));
  const RectifiedCamera camera(configuration.camera);
  ForegroundPublisher foreground(publisher, configuration, camera);
  foreground.publish(rawGreyMessage(1'000'000, cv::Mat1b(kHeight, kWidth, uchar{90})), CameraTime(), output);
  while (bus->handle(std::chrono::milliseconds(0)) > 0) {
  }
  return received;
}

TEST(ManyDetections, TheStrongestArePublishedInTheirOrder) {
  const auto limit = static_cast<size_t>(message_limits::kMaxDetections);
  const detections_t message = published(outputOf(2 * message_limits::kMaxDetections - 2));
  EXPECT_TRUE(isPlausible(message));
  ASSERT_EQ(message.detections.size(), limit);
  EXPECT_EQ(message.n, message_limits::kMaxDetections);
  int strong = 0;
  for (size_t i = 0; i < limit; ++i) {
    strong += message.detections[i].score > 0.5F ? 1 : 0;
    if (i > 0) {
      EXPECT_LT(message.detections[i - 1].id, message.detections[i].id);
    }
  }
  EXPECT_EQ(strong, message_limits::kMaxDetections - 1) << "all of them";
}

TEST(ManyDetections, AsManyAsFitAreAllPublished) {
  const detections_t message = published(outputOf(message_limits::kMaxDetections));
  EXPECT_TRUE(isPlausible(message));
  EXPECT_EQ(message.n, message_limits::kMaxDetections);
}

}  // namespace
}  // namespace redbee::test
