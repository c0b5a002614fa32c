// Appearance of the static scene: colour, variance and age per pixel, carried along with the camera (after Yi
// et al. 2013, whose model is on a coarse grid and in grey).
#pragma once

#include <opencv2/core.hpp>

#include "redbee/detection/parameters.hpp"
#include "redbee/imaging/warping.hpp"

namespace redbee {

/// Speed of a pixel's surface against the ground: speed [px] and its variance [px^2], over the
/// baseline of the motion. A tree's parallax is speed as well.
using SurfaceSpeed = cv::Mat2f;

class CarriedBackground {
 public:
  /// `evidence_sigmas`: by how many standard deviations a surface must be slower than the learned one to have
  /// half replaced it.
  CarriedBackground(const AppearanceParameters& parameters, const ShadowParameters& shadow,
                    double evidence_sigmas)
      : parameters_(parameters), shadow_(shadow), evidence_sigmas_(evidence_sigmas) {}

  void reset();
  /// The camera moves (pixels of the images that are compared and learned).
  void carry(const SceneMotion& scene);
  /// 0..1: d^2 / (d^2 + variance + noise^2 + (edge tolerance * slope)^2) of the pixel's difference d
  /// (libs/README.md, equation 29). Less where it may be the background in shadow, and where the background
  /// was learned from a surface that has moved away since; 0 where the model has no data. `image`: blue,
  /// green, red, anything.
  cv::Mat1f appearanceDifference(const cv::Mat4f& image, const SurfaceSpeed& speed) const;
  /// Moving pixels (`moving`: 0..1) are learned slowly, so that they leave no trail. `elapsed_s`:
  /// since the last image.
  void learn(const cv::Mat4f& image, const cv::Mat1f& moving, const SurfaceSpeed& speed, double elapsed_s);

 private:
  float movedAway(float learned_speed, const cv::Vec2f& speed) const;

  AppearanceParameters parameters_;
  ShadowParameters shadow_;
  double evidence_sigmas_;
  cv::Mat4f model_;  ///< mean colour (3, grey levels), variance about it (of one channel)
  cv::Mat1f speed_;  ///< px: speed of the surface that a pixel's model was learned from
  cv::Mat1b age_;    ///< images that a pixel's model was learned from, at most 255; 0: none
};

}  // namespace redbee
