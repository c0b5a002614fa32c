#include "redbee/detection/objects/disc_morphology.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "redbee/detection/objects/regions.hpp"

namespace redbee::test {
namespace {

cv::Mat1b blobs(const cv::Size& size, int every) {
  cv::Mat1b mask(size);
  cv::RNG random(size.width + every);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) mask(y, x) = random.uniform(0, every) == 0 ? 255 : 0;
  }
  cv::Mat1b grown;
  cv::dilate(mask, grown, cv::getStructuringElement(cv::MORPH_RECT, {3, 3}));
  return grown | (mask & 255);
}

TEST(DiscMorphology, IsOpenCvs) {
  for (const cv::Size& size :
       {cv::Size(1, 1), cv::Size(7, 5), cv::Size(64, 20), cv::Size(65, 9), cv::Size(200, 60)}) {
    for (const int every : {3, 12, 40}) {
      for (const int opening : {0, 1, 3, 4, 5}) {
        for (const int closing : {0, 3, 6, 7, 21}) {
          cv::Mat1b expected = blobs(size, every), mask = expected.clone();
          if (opening > 0) cv::morphologyEx(expected, expected, cv::MORPH_OPEN, disc(opening));
          if (closing > 0) cv::morphologyEx(expected, expected, cv::MORPH_CLOSE, disc(closing));
          openAndClose(mask, opening, closing);
          EXPECT_EQ(cv::norm(mask, expected, cv::NORM_INF), 0) << size << every << " " << opening << closing;
        }
      }
    }
  }
}

}  // namespace
}  // namespace redbee::test
