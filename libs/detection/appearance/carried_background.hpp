// Appearance of the static scene: colour, variance and age per pixel, carried along with the camera (after Yi
// et al. 2013, whose model is on a coarse grid and in grey).
#pragma once

#include <opencv2/core.hpp>

#include "redbee/detection/parameters.hpp"
#include "redbee/imaging/warping.hpp"

namespace redbee {

/// Speed of a pixel's surface against the ground: CV_32FC2, speed [px] and its variance [px^2], over the
/// baseline of the motion. A tree's parallax is speed as well.
using SurfaceSpeed = cv::Mat;

class CarriedBackground {
 public:
  explicit CarriedBackground(const SegmentationParameters& parameters) : parameters_(parameters) {}

  void reset();
  /// The camera moves (pixels of the images that are compared and learned).
  void carry(const SceneMotion& scene);
  /// CV_32F, 0..1: d^2 / (d^2 + variance + noise^2 + (edge tolerance * slope)^2) of the pixel's difference d
  /// (libs/README.md, equation 29). Less where it may be the background in shadow, and where the background
  /// was learned from a surface that has moved away since; 0 where the model has no data. `image`: CV_32FC4
  /// (blue, green, red, anything).
  cv::Mat appearanceDifference(const cv::Mat& image, const SurfaceSpeed& speed) const;
  /// Moving pixels (`moving`: CV_32F, 0..1) are learned slowly, so that they leave no trail. `elapsed_s`:
  /// since the last image.
  void learn(const cv::Mat& image, const cv::Mat& moving, const SurfaceSpeed& speed, double elapsed_s);

 private:
  float movedAway(float learned_speed, const cv::Vec2f& speed) const;

  SegmentationParameters parameters_;
  cv::Mat model_;  ///< CV_32FC4: mean colour (3, grey levels), variance about it (of one channel)
  cv::Mat speed_;  ///< CV_32F, px: speed of the surface that a pixel's model was learned from
  cv::Mat age_;    ///< CV_8U: images that a pixel's model was learned from, at most 255; 0: none
};

}  // namespace redbee
