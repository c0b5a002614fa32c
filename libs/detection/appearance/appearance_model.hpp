// Motion-compensated background model: colour, variance and age per pixel, warped into each frame (after Yi
// et al. 2013, whose model is grey and on a coarse grid).
#pragma once

#include <opencv2/core.hpp>

#include "redbee/detection/appearance/appearance_kernels.hpp"
#include "redbee/detection/appearance/background_warp.hpp"
#include "redbee/detection/parameters.hpp"
#include "redbee/imaging/spare_maps.hpp"
#include "redbee/imaging/warping.hpp"

namespace redbee {

/// Speed of a pixel's surface relative to the ground: speed [px] and its variance [px^2], over the baseline
/// of the motion. Parallax counts as speed, too.
using SurfaceSpeed = cv::Mat2f;

class AppearanceModel {
 public:
  /// `evidence_sigmas`: a surface slower than the learned one by so many standard deviations has replaced it
  /// with probability 1/2.
  AppearanceModel(const AppearanceParameters& parameters, const ShadowParameters& shadow,
                  double evidence_sigmas)
      : parameters_(parameters), shadow_(shadow), evidence_sigmas_(evidence_sigmas) {}

  void reset();
  /// Warps the model by the camera's motion, in pixels of the learned images.
  void propagate(const SceneMotion& scene, SpareMaps& spare);
  /// 0..1: d^2 / (d^2 + variance + noise^2 + (edge tolerance * slope)^2) of the pixel's difference d
  /// (libs/README.md, equation 29). Reduced in shadows, and where the surface that the model was learned from
  /// has moved away; 0 where the model has no data. `image`: blue, green, red, unused.
  cv::Mat1f appearanceDifference(const cv::Mat4b& image, const SurfaceSpeed& speed) const;
  /// Updates the model. Moving pixels (`moving`: 0..1) are learned slowly, so that they leave no trail.
  /// `elapsed_s`: since the last image.
  void learn(const cv::Mat4b& image, const cv::Mat1f& moving, const SurfaceSpeed& speed, double elapsed_s);

 private:
  SurfaceReset surfaceReset() const;

  AppearanceParameters parameters_;
  ShadowParameters shadow_;
  double evidence_sigmas_;
  BackgroundMaps maps_;
  BackgroundMaps warped_;  ///< speed and age of the frame before, whose memory is used again
};

}  // namespace redbee
