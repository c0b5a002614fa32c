// Images of a foreign size between those of the camera.
#include <gtest/gtest.h>

#include "tests/support/huge_image.hpp"
#include "tests/support/trusted_frames.hpp"

namespace redbee::test {
namespace {

/// A huge JPEG each second costs no frame.
TEST(ImageSize, AHugeImageIsRefusedByItsHeader) {
  StackFlight flight = undisturbedFlight();
  image_t huge = hugeImage();
  EXPECT_GT(huge.size, 1'000'000);
  std::vector<SensorMessage> messages;
  int frame = 0;
  for (const SensorMessage& sent : flight.messages) {
    messages.push_back(sent);
    if (sent.channel != "CAMERA" || ++frame % 24 != 12) continue;
    huge.utime = sent.utime + 20'000;
    messages.push_back(encoded(huge));
    messages.back().utime = sent.utime;
  }
  flight.messages = messages;
  const StackOutput output = StackRun(flight).run();
  const TrustedFrames frames = trustedFrames(output, flight);
  frames.print("a JPEG of 16384x16384 each second");
  EXPECT_EQ(frames.trusted, frames.expected);
  for (const char* process :
       {"redbee-imu-integration", "redbee-visual-homography", "redbee-motion-segmentation"}) {
    EXPECT_NE(output.health.at(process).message.find("16384x16384"), std::string::npos) << process;
  }
}

}  // namespace
}  // namespace redbee::test
