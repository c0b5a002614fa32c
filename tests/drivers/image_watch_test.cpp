#include "processes/camera/image_watch.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "redbee/bus/image.hpp"

namespace redbee::test {
namespace {

using testing::HasSubstr;

cv::Mat1b noisyImage(int seed, int level = 120) {
  cv::Mat1b image(48, 64);
  std::mt19937 random(static_cast<unsigned>(seed));
  for (uint8_t& pixel : image) pixel = static_cast<uint8_t>(level + static_cast<int>(random() % 16));
  return image;
}
int64_t timeOfImage(int k, double rate_hz = 25) {
  return 1'000'000 + static_cast<int64_t>(k * 1e6 / rate_hz);
}

TEST(ImageWatch, ACameraThatWorksHasNoFault) {
  ImageWatch watch(25);
  for (int k = 0; k < 100; ++k) {
    watch.note(k % 2 == 0 ? rawGreyMessage(timeOfImage(k), noisyImage(k))
                          : jpegMessage(timeOfImage(k), noisyImage(k), 80));
    EXPECT_EQ(watch.fault(), "");
  }
}

TEST(ImageWatch, EqualImagesAreFrozenAfterFive) {
  for (const bool is_jpeg : {false, true}) {
    ImageWatch watch(0);
    const auto note = [&](int k, int seed) {
      watch.note(is_jpeg ? jpegMessage(timeOfImage(k), noisyImage(seed), 80)
                         : rawGreyMessage(timeOfImage(k), noisyImage(seed)));
    };
    for (int k = 0; k < ImageWatch::kFrozenAfter; ++k) {
      note(k, 1);
      EXPECT_EQ(watch.fault(), "");
    }
    note(5, 1);
    EXPECT_THAT(watch.fault(), HasSubstr("frozen"));
    note(6, 2);
    EXPECT_EQ(watch.fault(), "");
  }
}

TEST(ImageWatch, ACoveredLensIsBlackThoughItsPixelsAreNoisy) {
  ImageWatch watch(0);
  for (int k = 0; k < 13; ++k) watch.note(jpegMessage(timeOfImage(k), noisyImage(k, 0), 90));
  EXPECT_THAT(watch.fault(), HasSubstr("black"));
  // One lamp in the night is an image.
  ImageWatch night(0);
  cv::Mat1b lamp = noisyImage(1, 0);
  lamp(cv::Rect(10, 10, 8, 8)) = 200;
  night.note(rawGreyMessage(1, lamp));
  EXPECT_EQ(night.fault(), "");
}

TEST(ImageWatch, FewerThanFourOfFiveAreSlow) {
  for (const double rate_hz : {24.0, 21.0, 19.0, 12.0}) {
    ImageWatch watch(25);
    for (int k = 0; k < 60; ++k) watch.note(rawGreyMessage(timeOfImage(k, rate_hz), noisyImage(k)));
    EXPECT_EQ(watch.fault().empty(), rate_hz > 20) << rate_hz;
  }
}

}  // namespace
}  // namespace redbee::test
