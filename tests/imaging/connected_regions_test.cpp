#include "redbee/imaging/connected_regions.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <vector>

namespace redbee {
namespace {

/// Those of OpenCV, in its order.
void expectOpenCvs(const cv::Mat1b& mask) {
  cv::Mat1i labels, statistics;
  cv::Mat1d centroids;
  const int count = cv::connectedComponentsWithStats(mask, labels, statistics, centroids, 8, CV_32S);
  const ConnectedRegions regions(mask);
  ASSERT_EQ(static_cast<int>(regions.size()), count - 1) << mask.size();
  std::vector<cv::Mat1b> pixels;  // of all, since they share memory
  for (size_t i = 0; i < regions.size(); ++i) pixels.push_back(regions.pixels(i));
  for (int label = 1; label < count; ++label) {
    const auto i = static_cast<size_t>(label - 1);
    const int* row = statistics[label];
    const cv::Rect box(row[cv::CC_STAT_LEFT], row[cv::CC_STAT_TOP], row[cv::CC_STAT_WIDTH],
                       row[cv::CC_STAT_HEIGHT]);
    EXPECT_EQ(regions.box(i), box);
    EXPECT_EQ(regions.area(i), row[cv::CC_STAT_AREA]);
    EXPECT_EQ(cv::countNonZero(pixels[i] != (labels(box) == label)), 0);
  }
}

TEST(ConnectedRegions, AreOpenCvsInItsOrder) {
  cv::RNG random(1);
  for (const cv::Size& size : {cv::Size(1, 1), cv::Size(1, 9), cv::Size(7, 1), cv::Size(64, 48),
                               cv::Size(33, 17), cv::Size(130, 5), cv::Size(5, 130)}) {
    for (const int percent : {0, 2, 20, 45, 60, 90, 100}) {
      cv::Mat1b noise(size);
      random.fill(noise, cv::RNG::UNIFORM, 0, 100);
      expectOpenCvs(noise < percent);
      if (size.width < 20) continue;
      cv::blur(noise, noise, {5, 5});  // larger regions
      expectOpenCvs(noise < percent);
    }
  }
}

TEST(ConnectedRegions, APartOfAnImageIsAnImage) {
  cv::Mat1b whole(40, 60, uint8_t{255});
  cv::Mat1b part = whole(cv::Rect(7, 5, 30, 20));
  part.setTo(0);
  part(cv::Rect(3, 4, 5, 6)).setTo(7);  // any value
  const ConnectedRegions regions(part);
  ASSERT_EQ(regions.size(), 1U);
  EXPECT_EQ(regions.box(0), cv::Rect(3, 4, 5, 6));
  EXPECT_EQ(cv::countNonZero(regions.pixels(0)), 30);
}

TEST(ConnectedRegions, OfNothingThereAreNone) { EXPECT_EQ(ConnectedRegions(cv::Mat1b()).size(), 0U); }

}  // namespace
}  // namespace redbee
