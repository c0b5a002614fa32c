#include "redbee/detection/objects/regions.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace redbee {
namespace {

TEST(Closed, IsThatOfOpenCvWhereverSomethingIsSet) {
  cv::RNG random(5);
  for (const cv::Size& size : {cv::Size(1, 1), cv::Size(7, 40), cv::Size(65, 47), cv::Size(160, 120)}) {
    for (const int blobs : {0, 1, 4, 40}) {
      for (const int diameter : {1, 3, 7, 19, 35}) {
        cv::Mat1b mask = cv::Mat1b::zeros(size);
        for (int i = 0; i < blobs; ++i) {
          const cv::Point at(random.uniform(0, size.width), random.uniform(0, size.height));
          cv::circle(mask, at, random.uniform(0, 5), 255, cv::FILLED);
        }
        cv::Mat1b expected;
        cv::morphologyEx(mask, expected, cv::MORPH_CLOSE, disc(diameter));
        EXPECT_EQ(cv::norm(closed(mask, diameter), expected, cv::NORM_INF), 0) << size << blobs << diameter;
      }
    }
  }
}

}  // namespace
}  // namespace redbee
