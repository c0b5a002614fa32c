// Background models of ground and front plane; foreground matches neither (paper III.A).
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>

#include "redbee/detection/two_planes/background_model.hpp"

namespace redbee {

class TwoPlaneBackground {
 public:
  TwoPlaneBackground(const TwoPlaneParameters& parameters, int learning_frames)
      : parameters_(parameters), learning_frames_(learning_frames) {}

  void reset();
  /// Compensates the camera's motion (homographies: previous to current). The model of a new front plane is
  /// initialised with the ground's; that of a lost one is deleted.
  void propagate(const Eigen::Matrix3d& ground, const std::optional<Eigen::Matrix3d>& front);
  /// The first image after a reset is learned without propagate().
  ForegroundMaps learn(const cv::Mat1b& grey);

 private:
  TwoPlaneParameters parameters_;
  int learning_frames_;
  std::optional<BackgroundModel> ground_;
  std::optional<BackgroundModel> front_;
};

}  // namespace redbee
