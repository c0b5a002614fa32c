// Foreground: motion that no static surface explains (M, parallax_evidence.hpp: reliable, but coarse) times
// the appearance difference to the background (A, carried_background.hpp: sharp, but trees and facades differ
// as well). P_FG = A M / (M + half): libs/README.md, equation 30.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>

#include "redbee/detection/appearance/carried_background.hpp"
#include "redbee/detection/parallax/parallax_evidence.hpp"
#include "redbee/detection/parameters.hpp"

namespace redbee {

class ForegroundEvidence {
 public:
  explicit ForegroundEvidence(const SegmentationParameters& parameters);

  void reset();
  /// The camera moves (previous to current; full-size pixels).
  void carry(const Eigen::Matrix3d& ground, const std::optional<Eigen::Matrix3d>& front,
             const std::optional<PlaneMotion>& motion, const Eigen::Matrix3d& K);

  struct Verdict {
    cv::Mat foreground;  ///< CV_8U, P_FG * 255, full size; empty where there is no earlier frame
    cv::Mat unseen;      ///< CV_8U, 255 where no earlier frame shows the scene
  };
  /// `grey`: CV_8U, `colour`: CV_8UC3 of the same size, or empty where the camera has none. `full`: the full
  /// size, which both may be smaller than.
  Verdict learn(int64_t utime, const cv::Mat& grey, const cv::Mat& colour, const Eigen::Matrix3d& K,
                cv::Size full);

 private:
  void fillRegions(const cv::Mat& image, cv::Mat& foreground) const;
  cv::Mat imageToCompare(const cv::Mat& grey, const cv::Mat& colour, cv::Size full) const;

  SegmentationParameters parameters_;
  Eigen::Matrix3d to_background_;  ///< full-size pixels to the background's
  ParallaxEvidence motion_;
  CarriedBackground background_;
  int64_t last_utime_ = 0;
};

}  // namespace redbee
