#include "redbee/imaging/chamfer_kernels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/core.hpp>

#include "tests/support/instruction_sets.hpp"

namespace redbee::test {
namespace {

using ChamferKernels = WithInstructions;
REDBEE_WITH_INSTRUCTIONS(ChamferKernels);

/// Steps until nothing changes.
cv::Mat1f relaxed(const cv::Mat1f& map, const ChamferSteps& steps) {
  cv::Mat1f now = map.clone();
  const auto at = [&](int y, int x) {
    return cv::Rect({}, now.size()).contains({x, y}) ? now(y, x) : steps.beyond;
  };
  for (bool is_changed = true; is_changed;) {
    is_changed = false;
    for (int y = 0; y < now.rows; ++y) {
      for (int x = 0; x < now.cols; ++x) {
        const float straight = std::min({at(y - 1, x), at(y + 1, x), at(y, x - 1), at(y, x + 1)});
        const float diagonal =
            std::min({at(y - 1, x - 1), at(y - 1, x + 1), at(y + 1, x - 1), at(y + 1, x + 1)});
        const float least = std::min({now(y, x), straight + steps.beside, diagonal + steps.diagonal});
        is_changed |= least < now(y, x);
        now(y, x) = least;
      }
    }
  }
  return now;
}

TEST_P(ChamferKernels, TwoPassesAreWhatStepsUntilNothingChangesGive) {
  cv::RNG random(5);
  for (const cv::Size& size :
       {cv::Size(1, 1), cv::Size(1, 6), cv::Size(2, 2), cv::Size(23, 17), cv::Size(40, 9)}) {
    for (const float beyond : {0.0F, 1e6F}) {
      cv::Mat1f memory(size.height, size.width + 3, -7.0F);  // rows lie further apart
      cv::Mat1f map = memory.colRange(0, size.width);
      for (float& value : map) value = random.uniform(0, 12) == 0 ? 0.0F : 1e6F;
      const ChamferSteps steps{0.955F, 1.369F, beyond};
      const cv::Mat1f expected = relaxed(map, steps);
      propagateDistances({map[0], map.step1(), size.width, size.height}, steps);
      for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x)
          EXPECT_NEAR(map(y, x), expected(y, x), 1e-6 * expected(y, x)) << size << x << "," << y;
        EXPECT_EQ(memory(y, size.width), -7) << "beyond the map";
      }
    }
  }
}

}  // namespace
}  // namespace redbee::test
