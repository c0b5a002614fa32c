#include "redbee/detection/rivals/image_history.hpp"

#include <gtest/gtest.h>

namespace redbee::test {
namespace {

TEST(ImageHistory, TheOldestAnswersToTheNewest) {
  const auto shift = [](double x) { return cv::Matx33d(1, 0, x, 0, 1, 0, 0, 0, 1); };
  const auto image = [](int grey) { return cv::Mat(2, 2, CV_8U, cv::Scalar(grey)); };
  ImageHistory history(2);
  EXPECT_TRUE(history.empty());
  history.push(image(1));
  history.propagate(shift(3));
  EXPECT_EQ(history.oldest().at<uint8_t>(0, 0), 1);
  EXPECT_EQ(history.oldestToNewest()(0, 2), 3);
  history.push(image(2));
  history.propagate(shift(4));
  EXPECT_EQ(history.oldest().at<uint8_t>(0, 0), 1);
  EXPECT_EQ(history.oldestToNewest()(0, 2), 7);
  history.push(image(3));
  history.propagate(shift(5));
  EXPECT_EQ(history.oldest().at<uint8_t>(0, 0), 2) << "two are kept";
  EXPECT_EQ(history.oldestToNewest()(0, 2), 9);
}

}  // namespace
}  // namespace redbee::test
