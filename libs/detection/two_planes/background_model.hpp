// The background of one plane: a Gaussian mixture that follows the plane's homography.
//
// The model lies on a canvas, the image with a border, and the current frame is warped onto it. When the
// view leaves the canvas or changes its scale, the model moves into the current view, one nearest-neighbour
// warp. With no border it moves every frame: the model is "carried along".
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "redbee/detection/foreground_maps.hpp"
#include "redbee/detection/parameters.hpp"
#include "redbee/detection/two_planes/gaussian_mixture.hpp"

namespace redbee {

class BackgroundModel {
 public:
  /// `learning_frames`: a pixel that was learned from fewer images is unknown.
  BackgroundModel(cv::Size image, const TwoPlaneParameters& parameters, int learning_frames);

  /// The camera moves by H (previous to current, pixels) and nothing is learned.
  void carry(const Eigen::Matrix3d& H);
  /// Classifies the image against the model, then learns it. carry() comes first.
  ForegroundMaps learn(const cv::Mat1b& grey);

 private:
  bool viewFitsCanvas() const;

  cv::Size image_;
  cv::Size canvas_;
  int learning_frames_;
  Eigen::Matrix3d to_canvas_;  ///< of a view that the canvas was laid around: the border's offset
  Eigen::Matrix3d view_;       ///< canvas pixels to current pixels
  GaussianMixture mixture_;
};

}  // namespace redbee
