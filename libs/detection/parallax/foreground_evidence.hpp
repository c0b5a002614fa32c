// Foreground from evidence of motion (M, parallax_evidence.hpp: reliable but coarse) and the appearance
// difference to the background (A, appearance_model.hpp: sharp, but also high on trees and facades). P_FG = A
// M / (M + half): libs/README.md, equation 30.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "redbee/detection/appearance/appearance_model.hpp"
#include "redbee/detection/foreground_maps.hpp"
#include "redbee/detection/parallax/ground_difference.hpp"
#include "redbee/detection/parallax/parallax_evidence.hpp"
#include "redbee/detection/parameters.hpp"
#include "redbee/geometry/time.hpp"

namespace redbee {

class ForegroundEvidence {
 public:
  ForegroundEvidence(const ParallaxParameters& parallax, const AppearanceParameters& appearance,
                     const ShadowParameters& shadow);

  void reset();
  /// AdjustableQuality's.
  std::vector<std::string> rungs() const;
  void setQuality(size_t rung);
  /// Propagates images and background by the camera's motion (previous to current; full-size pixels).
  void propagate(const Eigen::Matrix3d& ground, const std::optional<Eigen::Matrix3d>& front,
                 const std::optional<PlaneMotion>& motion, const CameraPair& cameras);

  /// Classifies the image, then learns it. Returns maps of the size `full`, empty if there is no earlier
  /// frame. `grey` may be smaller; `colour`: of grey's size, or empty if the camera is grey.
  /// `own_parts`: see FrameInput.
  ForegroundMaps learn(CameraTime time, const cv::Mat1b& grey, const cv::Mat3b& colour,
                       const Eigen::Matrix3d& K, cv::Size full, const cv::Mat1b& own_parts = {});

 private:
  void resizeToBackground(cv::Mat1f& foreground, SurfaceSpeed& speed, cv::Size size) const;
  void fillRegions(const cv::Mat4b& image, cv::Mat1f& foreground) const;
  cv::Mat4b imageToCompare(const cv::Mat1b& grey, const cv::Mat3b& colour, cv::Size full) const;

  ParallaxParameters parallax_;
  AppearanceParameters appearance_;
  int downscale_;                  ///< of the background model
  Eigen::Matrix3d to_background_;  ///< full-size pixels to the background's
  ParallaxEvidence motion_;
  AppearanceModel background_;
  std::optional<GroundDifference> ground_;  ///< if candidates are wanted
  bool is_complete_ = true;                 ///< nothing is left out
  SpareMaps spare_;
  CameraTime last_time_{};
};

}  // namespace redbee
