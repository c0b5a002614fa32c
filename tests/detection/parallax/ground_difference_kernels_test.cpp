#include "redbee/detection/parallax/ground_difference_kernels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "tests/support/instruction_sets.hpp"

namespace redbee::test {
namespace {

using GroundDifferenceRow = WithInstructions;
REDBEE_WITH_INSTRUCTIONS(GroundDifferenceRow);

cv::Mat1b noise(const cv::Size& size, int seed) {
  cv::Mat1b image(size);
  cv::RNG random(seed);
  random.fill(image, cv::RNG::UNIFORM, 0, 256);
  return image;
}

TEST_P(GroundDifferenceRow, VarianceIsThatOfSobelsGradient) {
  constexpr SlopeVariance kBy{36, 0.005625F};
  for (const cv::Size& size : {cv::Size(1, 1), cv::Size(2, 3), cv::Size(37, 4), cv::Size(64, 5)}) {
    const cv::Mat1b image = noise(size, 3);
    cv::Mat1s dx, dy;
    cv::Sobel(image, dx, CV_16S, 1, 0);
    cv::Sobel(image, dy, CV_16S, 0, 1);
    const int last = size.height - 1, next = std::min(1, last);
    for (int y = 0; y <= last; ++y) {
      const NeighbourRows rows{image[y > 0 ? y - 1 : next], image[y], image[y < last ? y + 1 : last - next],
                               size.width};
      for (const int begin : {0, size.width / 3}) {
        std::vector<float> variance(static_cast<size_t>(size.width), -1);
        varianceOfRow(rows, kBy, begin, size.width, variance.data());
        for (int x = 0; x < size.width; ++x) {
          const int squares = dx(y, x) * dx(y, x) + dy(y, x) * dy(y, x);
          const float expected = kBy.noise2 + kBy.per_square * static_cast<float>(squares);
          EXPECT_EQ(variance[static_cast<size_t>(x)], x < begin ? -1 : expected) << size << x << "," << y;
        }
      }
    }
  }
}

TEST_P(GroundDifferenceRow, KeepsTheLesserDifference) {
  constexpr int kWidth = 41;
  const cv::Mat1b now = noise({kWidth, 1}, 1), then = noise({kWidth, 1}, 2), before = noise({kWidth, 1}, 3);
  const cv::Mat1b unknown = noise({kWidth, 1}, 4) > 180;
  std::vector<float> variance(kWidth);
  for (int x = 0; x < kWidth; ++x) variance[static_cast<size_t>(x)] = 36 + 17.3F * static_cast<float>(x);
  for (const int begin : {0, 5}) {
    cv::Mat1b least = before.clone();
    keepLesser({now[0], then[0], unknown[0], variance.data()}, begin, kWidth - 1, least[0]);
    for (int x = 0; x < kWidth; ++x) {
      const auto d = static_cast<float>(now(0, x) - then(0, x));
      const int fraction = static_cast<int>(255 * d * d / (d * d + variance[static_cast<size_t>(x)]));
      const int lesser = std::min<int>(before(0, x), unknown(0, x) != 0 ? 0 : fraction);
      EXPECT_EQ(least(0, x), x < begin || x == kWidth - 1 ? before(0, x) : lesser) << x;
    }
  }
}

}  // namespace
}  // namespace redbee::test
