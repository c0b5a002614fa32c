// The paper's measures (IV.C; tests/README.md, "Measures"): precision and recall over the pixels of all
// labelled frames of a clip, while the threshold on P_FG sweeps.
#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

namespace redbee {

struct OperatingPoint {
  int threshold = 0;     ///< a pixel is detected where P_FG * 255 >= threshold
  double precision = 0;  ///< 1 where nothing is detected
  double recall = 0;     ///< 0 where nothing moves
};

/// Accumulates histograms only, so memory does not depend on the clip's length.
class PixelMeasures {
 public:
  /// `probability`: P_FG * 255. `truth`: 255 moves, 0 does not, any other value is ignored. Throws
  /// std::invalid_argument on maps of different sizes.
  void add(const cv::Mat1b& probability, const cv::Mat1b& truth);

  int64_t frames() const { return frames_; }
  int64_t movingPixels() const;
  int64_t backgroundPixels() const;
  /// Thresholds 255 down to 1: recall rises along the curve. P_FG = 0 is never a detection.
  std::vector<OperatingPoint> curve() const;
  /// 1 - precision where recall first reaches one half, linear between neighbouring thresholds; 1 where it
  /// never does.
  double errorAtHalfRecall() const;
  /// The largest 2 P R / (P + R) on the curve; 0 where there is none.
  double bestF1() const;
  OperatingPoint at(int threshold) const;

 private:
  std::array<int64_t, 256> moving_{};      ///< histogram of P_FG over moving pixels
  std::array<int64_t, 256> background_{};  ///< the same over static pixels
  int64_t frames_ = 0;
};

}  // namespace redbee
