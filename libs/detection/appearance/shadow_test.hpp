// Shadow detection: a shadow scales the background by one factor for all colours and preserves its texture
// (Horprasert et al. 1999; here over a window, relative to the noise).
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "redbee/detection/appearance/appearance_kernels.hpp"
#include "redbee/imaging/float_rows.hpp"

namespace redbee {

class ShadowTest {
 public:
  /// Both images: blue, green, red, unused; they are not copied, and `image` must outlive this. `noise`: grey
  /// levels, residual of a shadow after scaling.
  ShadowTest(FloatRows& image, const cv::Mat4f& background, double noise);

  /// For each pixel of row y: 0 (no shadow) to 1 (shadow). Rows must be requested in order, from 0.
  const std::vector<float>& row(int y);

 private:
  /// Of one row, over three neighbours.
  struct Sums {
    std::vector<float> values;
    ShadowSums of(size_t width) { return {values.data(), values.data() + width, values.data() + 2 * width}; }
  };
  void add(int y);

  FloatRows& image_;
  cv::Mat4f background_;
  float noise_variance_;
  int next_ = 0;
  std::vector<float> products_;
  Sums rows_[3];
  std::vector<float> shadow_;
};

}  // namespace redbee
