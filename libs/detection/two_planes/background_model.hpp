// The background model of one plane: a Gaussian mixture that is compensated by the plane's homography. The
// model is stored on a canvas, the image with a margin, onto which the current frame is warped. When the view
// leaves the canvas or changes its scale, the model is warped into the current view (nearest neighbour).
// Without a margin it is warped in every frame.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "redbee/detection/foreground_maps.hpp"
#include "redbee/detection/parameters.hpp"
#include "redbee/detection/two_planes/gaussian_mixture.hpp"

namespace redbee {

class BackgroundModel {
 public:
  /// `learning_frames`: pixels learned from fewer images are unknown.
  BackgroundModel(cv::Size image, const TwoPlaneParameters& parameters, int learning_frames);

  /// Compensates the camera's motion H (previous to current, pixels).
  void propagate(const Eigen::Matrix3d& H);
  /// Classifies the image against the model, then learns it. To be called after propagate().
  ForegroundMaps learn(const cv::Mat1b& grey);

 private:
  bool viewFitsCanvas() const;

  cv::Size image_;
  cv::Size canvas_;
  int learning_frames_;
  Eigen::Matrix3d to_canvas_;  ///< the margin's offset
  Eigen::Matrix3d view_;       ///< canvas pixels to current pixels
  GaussianMixture mixture_;
};

}  // namespace redbee
