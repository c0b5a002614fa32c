// Shadow detection: a shadow scales the background by one factor for all colours and preserves its texture
// (Horprasert et al. 1999; here over a window, relative to the noise).
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace redbee {

class ShadowTest {
 public:
  /// Both images: blue, green, red, unused; they are not copied. `noise`: grey levels, residual of a shadow
  /// after scaling.
  ShadowTest(const cv::Mat4f& image, const cv::Mat4f& background, double noise);

  /// For each pixel of row y: 0 (no shadow) to 1 (shadow). Rows must be requested in order, from 0.
  const std::vector<float>& row(int y);

 private:
  /// Sums over three neighbours of a row: image squared, image times background, background squared.
  struct Sums {
    std::vector<float> pp, pb, bb;
  };
  void add(int y);
  float score(float pp, float pb, float bb) const;

  cv::Mat4f image_;
  cv::Mat4f background_;
  float noise_variance_;
  int next_ = 0;
  Sums products_;
  Sums rows_[3];
  std::vector<float> shadow_;
};

}  // namespace redbee
