// Foreground is what neither the ground nor the front plane explains (paper III.A).
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
  /// The camera moves (homographies previous to current). A new front plane starts with the ground's model,
  /// so that it has data; one that is lost is deleted.
  void carry(const Eigen::Matrix3d& ground, const std::optional<Eigen::Matrix3d>& front);
  /// The first image after a reset is learned without carry().
  ForegroundMaps learn(const cv::Mat1b& grey);

 private:
  TwoPlaneParameters parameters_;
  int learning_frames_;
  std::optional<BackgroundModel> ground_;
  std::optional<BackgroundModel> front_;
};

}  // namespace redbee
