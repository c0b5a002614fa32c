#include "redbee/visual/sharpness.hpp"

#include <Eigen/Core>
#include <cstdint>

#include "redbee/geometry/small_decompositions.hpp"
#include "redbee/visual/sharpness_kernels.hpp"

namespace redbee {

double sharpnessOf(const cv::Mat1b& half) {
  if (half.empty()) return 0;
  GradientProducts total{0, 0, 0};
  for (int y = 1; y + 1 < half.rows; ++y) {
    const uint8_t* const rows[3] = {half.ptr(y - 1), half.ptr(y), half.ptr(y + 1)};
    const GradientProducts row = gradientProducts(rows, static_cast<size_t>(half.cols));
    total.xx += row.xx;
    total.xy += row.xy;
    total.yy += row.yy;
  }
  constexpr double kSobelGain = 8;
  const double scale = 1 / (kSobelGain * kSobelGain * (half.cols - 2.0) * (half.rows - 2.0));
  Eigen::Matrix2d tensor;
  tensor << static_cast<double>(total.xx), static_cast<double>(total.xy), static_cast<double>(total.xy),
      static_cast<double>(total.yy);
  return smallestEigenvalue(scale * tensor);
}

}  // namespace redbee
