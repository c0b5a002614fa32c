// Foreground: motion that no static surface explains (M, parallax_evidence.hpp: reliable, but coarse) times
// the appearance difference to the background (A, carried_background.hpp: sharp, but trees and facades differ
// as well). P_FG = A M / (M + half): libs/README.md, equation 30.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>

#include "redbee/detection/appearance/carried_background.hpp"
#include "redbee/detection/foreground_maps.hpp"
#include "redbee/detection/parallax/parallax_evidence.hpp"
#include "redbee/detection/parameters.hpp"

namespace redbee {

class ForegroundEvidence {
 public:
  ForegroundEvidence(const ParallaxParameters& parallax, const AppearanceParameters& appearance,
                     const ShadowParameters& shadow);

  void reset();
  /// The camera moves (previous to current; full-size pixels).
  void carry(const Eigen::Matrix3d& ground, const std::optional<Eigen::Matrix3d>& front,
             const std::optional<PlaneMotion>& motion, const Eigen::Matrix3d& K);

  /// Maps of the size `full`, empty if there is no earlier frame. `grey` may be smaller than that; `colour`:
  /// of grey's size, or empty if the camera has none.
  ForegroundMaps learn(int64_t utime, const cv::Mat1b& grey, const cv::Mat3b& colour,
                       const Eigen::Matrix3d& K, cv::Size full);

 private:
  void fillRegions(const cv::Mat4f& image, cv::Mat1f& foreground) const;
  cv::Mat4f imageToCompare(const cv::Mat1b& grey, const cv::Mat3b& colour, cv::Size full) const;

  ParallaxParameters parallax_;
  AppearanceParameters appearance_;
  int downscale_;                  ///< of the background
  Eigen::Matrix3d to_background_;  ///< full-size pixels to the background's
  ParallaxEvidence motion_;
  CarriedBackground background_;
  int64_t last_utime_ = 0;
};

}  // namespace redbee
