#include "redbee/detection/parallax/alignment_kernels.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <vector>

#include "tests/support/instruction_sets.hpp"

namespace redbee::test {
namespace {

using AlignRow = WithInstructions;
REDBEE_WITH_INSTRUCTIONS(AlignRow);

/// Small shifts leave most of the rows inside, large ones none; shear and perspective make places uneven.
const std::vector<cv::Matx33d> kBack = {{1, 0, 0, 0, 1, 0, 0, 0, 1},
                                        {1, 0, 0.4, 0, 1, -0.7, 0, 0, 1},
                                        {1, 0.02, -3.3, -0.03, 1, 5.1, 0, 0, 1},
                                        {1.1, 0.1, -8, 0.05, 0.9, 4, 1e-3, -2e-3, 1},
                                        {0.2, 0, 30, 0, 0.2, 20, 0, 0, 1},
                                        {1, 0, 500, 0, 1, 0, 0, 0, 1}};

TEST_P(AlignRow, IsOpenCvsWarp) {
  cv::RNG random(4);
  for (const cv::Size& size : {cv::Size(2, 2), cv::Size(5, 4), cv::Size(37, 23), cv::Size(96, 64)}) {
    cv::Mat1b earlier(size);
    random.fill(earlier, cv::RNG::UNIFORM, 0, 256);
    for (const cv::Matx33d& back : kBack) {
      cv::Mat1b expected, shown;
      constexpr int kInverse = cv::WARP_INVERSE_MAP;
      cv::warpPerspective(earlier, expected, back, size, cv::INTER_LINEAR | kInverse);
      cv::warpPerspective(cv::Mat1b(size, 255), shown, back, size, cv::INTER_NEAREST | kInverse);
      cv::Mat1b grey(size), unknown(size);
      std::vector<int32_t> places(2 * static_cast<size_t>(size.width));
      for (int y = 0; y < size.height; ++y) {
        alignPixels({earlier.data, earlier.step, size.width, size.height}, back.val,
                    {y, 0, size.width, places.data(), grey[y], unknown[y]});
      }
      // With perspective a place may round the other way: one step of 1/32 px.
      const double most = back(2, 0) == 0 ? 0 : 255.0 / 32 + 1;
      EXPECT_LE(cv::norm(grey, expected, cv::NORM_INF), most) << size << back;
      EXPECT_LE(cv::countNonZero(grey != expected), back(2, 0) == 0 ? 0 : 3) << size << back;
      EXPECT_EQ(cv::norm(unknown, ~shown, cv::NORM_INF), 0) << size << back;
    }
  }
}

/// Where places turn around within a row, and everywhere else.
TEST_P(AlignRow, IsTheSamePixelByPixel) {
  std::vector<cv::Matx33d> all = kBack;
  all.push_back({1, 0, 0, 0, 1, 0, 0.02, 0, -1});
  all.push_back({-1, 0, 50, 0, 1, 3, 0, 0, 1});
  all.push_back({0, 0, 5, 0, 1, 0, 0, 0, 1});
  const cv::Size size(96, 20);
  cv::Mat1b earlier(size);
  cv::randu(earlier, 0, 256);
  const EarlierImage image{earlier.data, earlier.step, size.width, size.height};
  for (const cv::Matx33d& back : all) {
    cv::Mat1b grey(size), unknown(size), pixel_grey(size), pixel_unknown(size);
    std::vector<int32_t> places(2 * static_cast<size_t>(size.width));
    for (int y = 0; y < size.height; ++y) {
      alignPixels(image, back.val, {y, 0, size.width, places.data(), grey[y], unknown[y]});
      for (int x = 0; x < size.width; ++x)
        alignPixels(image, back.val, {y, x, x + 1, places.data(), pixel_grey[y], pixel_unknown[y]});
    }
    EXPECT_EQ(cv::norm(grey, pixel_grey, cv::NORM_INF), 0) << back;
    EXPECT_EQ(cv::norm(unknown, pixel_unknown, cv::NORM_INF), 0) << back;
  }
}

}  // namespace
}  // namespace redbee::test
