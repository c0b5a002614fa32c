#include "redbee/detection/two_planes/two_plane_background.hpp"

namespace redbee {

void TwoPlaneBackground::reset() {
  ground_.reset();
  front_.reset();
}

void TwoPlaneBackground::propagate(const Eigen::Matrix3d& ground,
                                   const std::optional<Eigen::Matrix3d>& front) {
  if (!ground_) return;
  if (!front || !parameters_.use_front_plane) {
    front_.reset();
  } else {
    if (!front_) front_ = ground_;
    front_->propagate(*front);
  }
  ground_->propagate(ground);
}

ForegroundMaps TwoPlaneBackground::learn(const cv::Mat1b& grey) {
  if (!ground_) ground_.emplace(grey.size(), parameters_, learning_frames_);
  ForegroundMaps ground = ground_->learn(grey);
  if (!front_) return ground;
  const ForegroundMaps front = front_->learn(grey);
  ForegroundMaps both;
  both.foreground = ground.foreground & front.foreground;
  // A pixel that is background for one plane is background, also where the other has no data.
  const cv::Mat1b not_background_ground = ground.foreground | ground.unknown;
  const cv::Mat1b not_background_front = front.foreground | front.unknown;
  both.unknown = (ground.unknown & not_background_front) | (front.unknown & not_background_ground);
  return both;
}

}  // namespace redbee
