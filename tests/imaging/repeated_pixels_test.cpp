#include "redbee/imaging/repeated_pixels.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace redbee {
namespace {

TEST(RepeatedPixels, AreThoseOfOpenCv) {
  cv::RNG random(2);
  for (const cv::Size& size : {cv::Size(1, 1), cv::Size(15, 3), cv::Size(16, 2), cv::Size(33, 7)}) {
    cv::Mat1b mask(size);
    random.fill(mask, cv::RNG::UNIFORM, 0, 256);
    for (const cv::Size& full : {size, size * 2, size * 4, size * 2 + cv::Size(1, 0)}) {
      cv::Mat1b expected;
      cv::resize(mask, expected, full, 0, 0, cv::INTER_NEAREST);
      EXPECT_EQ(cv::norm(repeatedPixels(mask, full), expected, cv::NORM_INF), 0) << size << full;
    }
  }
}

}  // namespace
}  // namespace redbee
