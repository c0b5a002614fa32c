#include "redbee/detection/objects/moving_components.hpp"

#include <gtest/gtest.h>

namespace redbee {
namespace {

const cv::Size kSize{80, 60};

cv::Mat1f movingIn(const cv::Rect& where) {
  cv::Mat1f moving = cv::Mat1f::zeros(kSize);
  moving(where) = 1;
  return moving;
}

ForegroundComponents components(const cv::Mat1b& probability, const cv::Mat1f& moving,
                                const cv::Mat1b& unknown = cv::Mat1b::zeros(kSize)) {
  return findComponents(probability, unknown, ObjectParameters{}, {{}, {}, moving});
}

TEST(MovingComponents, AreFoundWhereNothingElseIs) {
  const cv::Rect where(20, 10, 12, 20);
  const ForegroundComponents found = components(cv::Mat1b::zeros(kSize), movingIn(where));
  ASSERT_EQ(found.components.size(), 1U);
  EXPECT_EQ(found.components[0].box, where);
  EXPECT_EQ(found.components[0].area_px, where.area());
  EXPECT_EQ(cv::countNonZero(found.mask()), where.area());
}

TEST(MovingComponents, RaiseTheGainOfAComponentThatCoversThem) {
  cv::Mat1b probability = cv::Mat1b::zeros(kSize);
  probability(cv::Rect(20, 10, 12, 20)) = 200;
  const ForegroundComponents found = components(probability, movingIn({22, 12, 8, 10}));
  ASSERT_EQ(found.components.size(), 1U);
  EXPECT_GT(found.components[0].gain, 1);
}

TEST(MovingComponents, LeaveASmallComponentItsPixels) {
  cv::Mat1b probability = cv::Mat1b::zeros(kSize);
  probability(cv::Rect(30, 20, 7, 7)) = 200;
  const ForegroundComponents found = components(probability, movingIn({20, 10, 30, 30}));
  ASSERT_EQ(found.components.size(), 2U);
  for (size_t i = 0; i < 2; ++i)
    EXPECT_EQ(cv::countNonZero(found.mask({i})), found.components[i].area_px) << i;
  EXPECT_EQ(cv::countNonZero(found.mask()), 30 * 30);
}

TEST(MovingComponents, EndWhereNothingIsKnown) {
  cv::Mat1b unknown = cv::Mat1b::zeros(kSize);
  unknown(cv::Rect(30, 0, 3, 60)) = 255;
  const ForegroundComponents found = components(cv::Mat1b::zeros(kSize), movingIn({20, 10, 30, 30}), unknown);
  EXPECT_EQ(cv::countNonZero(found.mask() & unknown), 0);
  EXPECT_EQ(found.components.size(), 2U);
}

}  // namespace
}  // namespace redbee
