#include "redbee/detection/rivals/registration.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/support/sliding_patch.hpp"

namespace redbee::test {
namespace {

TEST(Registrar, FindsTheGroundsHomography) {
  Registrar registrar;
  EXPECT_FALSE(registrar.advance(slidingPatch()[0].input.grey));
  for (size_t k = 1; k < 5; ++k) {
    const auto found = registrar.advance(slidingPatch()[k].input.grey);
    ASSERT_TRUE(found);
    Eigen::Matrix3d H;
    cv::cv2eigen(*found, H);
    EXPECT_LT(meanTransferError(H, trueStep(k), 480, 360), 0.15);
  }
}

TEST(Registrar, UnrelatedImagesAreNotRegistered) {
  Registrar registrar;
  registrar.advance(slidingPatch()[0].input.grey);
  cv::Mat noise(slidingPatch()[0].input.grey.size(), CV_8U);
  cv::RNG(5).fill(noise, cv::RNG::UNIFORM, 0, 255);
  EXPECT_FALSE(registrar.advance(noise));
}

TEST(Registrar, ATenthOfTheImageIsEnough) {
  GridTracks tracks;
  std::mt19937 random(7);
  std::uniform_real_distribution<float> anywhere(-12, 12);
  for (const cv::Point2f& point : gridPoints({640, 480}, {32, 24})) {
    const Eigen::Vector2d moved = transfer(trueStep(1), Eigen::Vector2d(point.x, point.y));
    const bool follows = tracks.previous.size() % 10 == 0;
    tracks.previous.push_back(point);
    tracks.current.emplace_back(static_cast<float>(moved.x()) + (follows ? 0 : anywhere(random)),
                                static_cast<float>(moved.y()) + (follows ? 0 : anywhere(random)));
  }
  tracks.sampled = tracks.previous.size();
  const auto found = registerTracks(tracks);
  ASSERT_TRUE(found);
  Eigen::Matrix3d H;
  cv::cv2eigen(*found, H);
  EXPECT_LT(meanTransferError(H, trueStep(1), 640, 480), 1);
}

}  // namespace
}  // namespace redbee::test
