#include "redbee/visual/sharpness.hpp"

#include <Eigen/Core>
#include <cstdint>

#include "redbee/geometry/small_decompositions.hpp"

namespace redbee {

double sharpnessOf(const cv::Mat1b& half) {
  if (half.empty()) return 0;
  int64_t xx = 0, xy = 0, yy = 0;
  for (int y = 1; y + 1 < half.rows; ++y) {
    const uint8_t* above = half.ptr(y - 1);
    const uint8_t* row = half.ptr(y);
    const uint8_t* below = half.ptr(y + 1);
    int32_t row_xx = 0, row_xy = 0, row_yy = 0;
    for (int x = 1; x + 1 < half.cols; ++x) {
      const int dx =
          above[x + 1] - above[x - 1] + 2 * (row[x + 1] - row[x - 1]) + below[x + 1] - below[x - 1];
      const int dy = below[x - 1] - above[x - 1] + 2 * (below[x] - above[x]) + below[x + 1] - above[x + 1];
      row_xx += dx * dx;
      row_xy += dx * dy;
      row_yy += dy * dy;
    }
    xx += row_xx;
    xy += row_xy;
    yy += row_yy;
  }
  constexpr double kSobelGain = 8;
  const double scale = 1 / (kSobelGain * kSobelGain * (half.cols - 2.0) * (half.rows - 2.0));
  Eigen::Matrix2d tensor;
  tensor << static_cast<double>(xx), static_cast<double>(xy), static_cast<double>(xy),
      static_cast<double>(yy);
  return smallestEigenvalue(scale * tensor);
}

}  // namespace redbee
