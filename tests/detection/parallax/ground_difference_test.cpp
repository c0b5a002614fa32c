// Images of a textured ground that the camera slides over, and something that moves on it, or stands above
// it.
#include "redbee/detection/parallax/ground_difference.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace redbee {
namespace {

constexpr int kStep_px = 3;  // of the ground, to the left, in each frame
const Eigen::Matrix3d kK = (Eigen::Matrix3d() << 150, 0, 80, 0, 150, 60, 0, 0, 1).finished();

cv::Mat1b groundTexture() {
  cv::Mat1b texture(120, 400);
  cv::RNG random(7);
  random.fill(texture, cv::RNG::UNIFORM, 60, 200);
  cv::GaussianBlur(texture, texture, {0, 0}, 1.2);
  return texture;
}

/// Frame k: a window on the ground, and a dark box at `x`, where there is one.
cv::Mat1b image(const cv::Mat1b& texture, int k, int x = -1) {
  cv::Mat1b image = texture(cv::Rect(kStep_px * k, 0, 160, 120)).clone();
  if (x >= 0) image(cv::Rect(x, 50, 10, 10)).setTo(10);
  return image;
}

/// After `frames` frames at 24 Hz; `place`: of the box in frame k.
template <typename Place>
cv::Mat1b differenceAfter(int frames, const Place& place) {
  const cv::Mat1b texture = groundTexture();
  Eigen::Matrix3d ground = Eigen::Matrix3d::Identity();
  ground(0, 2) = -kStep_px;
  GroundDifference difference;
  cv::Mat1b last;
  for (int k = 0; k < frames; ++k) {
    if (k > 0) difference.propagate(ground, std::nullopt);
    last =
        difference.learn(CameraTime(std::chrono::microseconds(41667 * k)), image(texture, k, place(k)), kK);
  }
  difference.complete({0, 0, last.cols, last.rows});
  return last;
}

double meanIn(const cv::Mat1b& map, const cv::Rect& box) { return cv::mean(map(box))[0]; }

TEST(GroundDifference, IsNothingOnTheRegisteredGround) {
  const cv::Mat1b difference = differenceAfter(20, [](int) { return -1; });
  EXPECT_LT(meanIn(difference, {5, 5, 100, 110}), 1);
}

TEST(GroundDifference, IsHighOnWhatMovesAndNotWhereItWas) {
  // It goes 4 px a frame to the right over the ground, that is 1 px in the image.
  const cv::Mat1b difference = differenceAfter(20, [](int k) { return 40 + k; });
  EXPECT_GT(meanIn(difference, {59, 50, 10, 10}), 150);
  EXPECT_LT(meanIn(difference, {20, 50, 30, 10}), 5)
      << "where it was over the ground, a sixth to half of a second ago";
}

TEST(GroundDifference, IsNothingOnWhatRestsOnTheGround) {
  const cv::Mat1b difference = differenceAfter(20, [](int k) { return 120 - kStep_px * k; });
  EXPECT_LT(meanIn(difference, {63, 50, 10, 10}), 5);
}

TEST(GroundDifference, IsTheSameInPartsAndAsAWhole) {
  const cv::Mat1b texture = groundTexture();
  Eigen::Matrix3d ground = Eigen::Matrix3d::Identity();
  ground(0, 2) = -kStep_px;
  GroundDifference of_parts, of_whole;
  for (int k = 0; k < 16; ++k) {
    if (k > 0) of_parts.propagate(ground, std::nullopt);
    if (k > 0) of_whole.propagate(ground, std::nullopt);
    const CameraTime time(std::chrono::microseconds(41667 * k));
    const cv::Mat1b parts = of_parts.learn(time, image(texture, k, 40 + k), kK);
    const cv::Mat1b whole = of_whole.learn(time, image(texture, k, 40 + k), kK);
    of_whole.complete({0, 0, whole.cols, whole.rows});
    for (const cv::Rect& part : {cv::Rect(3, 2, 20, 10), cv::Rect(10, 5, 60, 40), cv::Rect(100, 90, 80, 60),
                                 cv::Rect(0, 0, 160, 120)}) {
      of_parts.complete(part);
      const cv::Rect inside = part & cv::Rect({}, parts.size());
      ASSERT_EQ(cv::norm(parts(inside), whole(inside), cv::NORM_INF), 0) << k << part;
    }
  }
}

TEST(GroundDifference, SaysNothingWithoutAnEarlierImage) {
  EXPECT_EQ(cv::countNonZero(differenceAfter(1, [](int k) { return 40 + k; })), 0);
}

}  // namespace
}  // namespace redbee
