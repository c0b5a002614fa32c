// What the static scene looks like, in colour, pixel by pixel: carried along with the camera, and aware of
// how well it knows each pixel (after Yi et al. 2013, whose model is carried too, on a coarse grid and in
// grey).
#pragma once

#include <opencv2/core.hpp>

#include "segmentation/parameters.hpp"
#include "segmentation/warping.hpp"

namespace redbee {

class CarriedBackground {
 public:
  explicit CarriedBackground(const SegmentationParameters& parameters) : parameters_(parameters) {}

  void reset();
  /// The view moves (pixels of the pictures that are compared and learned).
  void carry(const SceneMotion& scene);
  /// d^2 / (d^2 + variance + noise^2) of the pixel's mean difference d over a small window, CV_32F 0..1; 0
  /// where the model has not seen the scene. `colour`: CV_8UC3.
  cv::Mat unlike(const cv::Mat& colour) const;
  /// What moves (CV_32F, 0..1) is learned slowly, so that it leaves no trail. `elapsed_s`: since the last
  /// picture.
  void learn(const cv::Mat& colour, const cv::Mat& moving, double elapsed_s);

 private:
  SegmentationParameters parameters_;
  cv::Mat model_;  ///< CV_32FC4: mean colour (3, grey levels), variance about it (of one channel)
  cv::Mat age_;    ///< CV_8U: pictures that a pixel's model was learned from, at most 255; 0: none
};

}  // namespace redbee
