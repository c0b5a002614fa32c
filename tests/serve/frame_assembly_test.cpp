#include "processes/serve/frame_assembly.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "redbee/bus/image.hpp"
#include "tests/support/camera.hpp"

namespace redbee::test {
namespace {

constexpr int64_t kUtime = 1'000'000'000;

FrameView frameOf(const cv::Size& size) {
  Configuration configuration;
  configuration.camera = intrinsics();
  FrameAssembly assembly(configuration);
  assembly.onImage(rawGreyMessage(kUtime, cv::Mat1b::zeros(size)));
  detections_t detections{};
  detections.utime = kUtime;
  assembly.onDetections(detections);
  return assembly.takeFrame().value();
}

TEST(FrameAssembly, PutsImageAndDetectionsTogether) {
  const FrameView frame = frameOf({kWidth, kHeight});
  EXPECT_TRUE(frame.image);
  EXPECT_TRUE(frame.detections);
  EXPECT_EQ(frame.note, "");
}

TEST(FrameAssembly, SaysThatTheImagesAreOfAnotherCamera) {
  EXPECT_THAT(frameOf({kWidth / 2, kHeight}).note, testing::HasSubstr("another camera"));
}

}  // namespace
}  // namespace redbee::test
