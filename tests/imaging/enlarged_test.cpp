#include "redbee/imaging/enlarged.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "tests/support/instruction_sets.hpp"

namespace redbee::test {
namespace {

using Enlarged = WithInstructions;
REDBEE_WITH_INSTRUCTIONS(Enlarged);

TEST_P(Enlarged, IsOpenCvs) {
  cv::RNG random(3);
  for (const cv::Size& size :
       {cv::Size(1, 1), cv::Size(2, 1), cv::Size(15, 3), cv::Size(33, 7), cv::Size(320, 24)}) {
    for (const int brightest : {2, 256}) {
      cv::Mat1b map(size);
      random.fill(map, cv::RNG::UNIFORM, 0, brightest);
      if (brightest == 2) map *= 255;
      for (const cv::Size& full : {size, size * 2, size * 4, size * 2 + cv::Size(1, 0)}) {
        cv::Mat1b expected;
        cv::resize(map, expected, full, 0, 0, cv::INTER_LINEAR);
        EXPECT_EQ(cv::norm(enlarged(map, full), expected, cv::NORM_INF), 0) << size << full;
      }
    }
  }
}

}  // namespace
}  // namespace redbee::test
