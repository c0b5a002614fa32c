// What no static surface at any depth explains: dense flow against the camera's motion (plane plus parallax;
// Irani and Anandan 1998).
//
// An earlier frame is laid onto the current one by the ground homography (above the horizon, where there is
// no ground, by the rotation). Flow that remains and lies off the segment of possible parallax
// (parallax_segment.hpp), and that the grey values bear out (photometric_test.hpp), is evidence. It travels
// along the flow from frame to frame, so that what moves steadily adds up and noise does not.
#pragma once

#include <cstdint>
#include <deque>
#include <opencv2/core.hpp>
#include <opencv2/video/tracking.hpp>
#include <optional>

#include "geometry/homography.hpp"
#include "segmentation/parameters.hpp"

namespace redbee {

class ParallaxEvidence {
 public:
  explicit ParallaxEvidence(const SegmentationParameters& parameters);

  void reset();
  /// The view moves (previous to current).
  void carry(const Eigen::Matrix3d& ground, const std::optional<PlaneMotion>& motion);
  /// Evidence of motion per pixel, CV_32F 0..1, against the earlier frame that `baseline_s` asks for (the
  /// oldest there is, while there is none so old); empty where there is none at all. Remembers the picture.
  cv::Mat learn(int64_t utime, const cv::Mat& grey, const Eigen::Matrix3d& K);

  /// 255 where the earlier frame of the last learn() does not show the scene.
  const cv::Mat& unseen() const { return unseen_; }

 private:
  struct Frame {
    int64_t utime = 0;
    cv::Mat grey;
    Eigen::Matrix3d ground = Eigen::Matrix3d::Identity();  ///< this frame's pixels to the current frame's
    std::optional<PlaneMotion> motion;                     ///< from this frame to the current one
    bool still = true;                                     ///< no carry() since: `motion` is the identity
  };

  const Frame* reference(int64_t utime) const;
  cv::Mat alignReference(const Frame& frame, const Eigen::Matrix3d& K);
  cv::Mat denseFlow(const cv::Mat& now, const cv::Mat& then);
  cv::Mat judgeFlow(const Frame& frame, const Eigen::Matrix3d& K, const cv::Mat& flow, const cv::Mat& now,
                    const cv::Mat& then) const;
  cv::Mat accumulate(const cv::Mat& evidence, const cv::Mat& flow, double share) const;
  void remember(int64_t utime, const cv::Mat& grey);

  SegmentationParameters parameters_;
  cv::Ptr<cv::DISOpticalFlow> dis_;
  std::deque<Frame> frames_;  ///< oldest first
  Eigen::Matrix3d last_step_ = Eigen::Matrix3d::Identity();
  cv::Mat accumulated_;  ///< CV_32F, the evidence of the frames before
  cv::Mat unseen_;
};

}  // namespace redbee
