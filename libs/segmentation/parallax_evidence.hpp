// What no static surface at any depth explains (plane plus parallax; Irani and Anandan 1998).
//
// Earlier pictures are laid onto the current one by the ground homography (above the horizon, where there is
// no ground, by the rotation). Two questions, each averaged along what moves (travelling_evidence.hpp):
// - motion: does the dense flow that remains lie off the segment of possible parallax (parallax_segment.hpp)?
//   It knows trees and facades, but its outlines are coarse.
// - appearance: does the pixel look like the static scene in neither of two earlier pictures? Its outlines
//   are sharp, but trees and facades differ too. One of two is enough to be static, so that the place an
//   object has left does not count.
// The evidence is their product, the motion filled up to the picture's edges by a guided filter.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/video/tracking.hpp>
#include <optional>
#include <vector>

#include "geometry/homography.hpp"
#include "segmentation/earlier_frames.hpp"
#include "segmentation/parameters.hpp"
#include "segmentation/travelling_evidence.hpp"

namespace redbee {

/// Dense inverse-search flow for pictures this much smaller than the camera's.
cv::Ptr<cv::DISOpticalFlow> makeMotionFlow(int work_downscale);

class ParallaxEvidence {
 public:
  explicit ParallaxEvidence(const SegmentationParameters& parameters);

  void reset();
  /// The view moves (previous to current; full-size pixels).
  void carry(const Eigen::Matrix3d& ground, const std::optional<PlaneMotion>& motion);
  /// Evidence of motion per pixel, CV_32F 0..1; empty where there is no earlier frame. Remembers the picture.
  cv::Mat learn(int64_t utime, const cv::Mat& grey, const Eigen::Matrix3d& K);

  /// 255 where the earlier frame of the last learn() does not show the scene.
  const cv::Mat& unseen() const { return unseen_; }

 private:
  struct FlowVerdict {
    FrameEvidence evidence;    ///< `appearance` still empty
    cv::Mat static_displaced;  ///< CV_32FC2, px: to where a static pixel was in the aligned earlier picture
  };

  cv::Mat evidence(const cv::Mat& grey, const Eigen::Matrix3d& K, int64_t utime);
  FlowVerdict judgeFlow(const EarlierFrame& frame, const Eigen::Matrix3d& K, const cv::Mat& grey,
                        const cv::Mat& flow, double frames) const;
  cv::Mat flowVariance(const cv::Mat& grey) const;
  cv::Mat unlikeStatic(const cv::Mat& grey, const Eigen::Matrix3d& K, int64_t utime,
                       const AlignedPicture& reference, const cv::Mat& static_displaced) const;

  SegmentationParameters parameters_;
  double scale_;          ///< full-size pixels to a pixel of the work
  Eigen::Matrix3d work_;  ///< full-size pixels to the work's
  cv::Ptr<cv::DISOpticalFlow> dis_;
  EarlierFrames frames_;
  TravellingEvidence travelling_;
  Eigen::Matrix3d last_step_ = Eigen::Matrix3d::Identity();  ///< in the work's pixels
  cv::Mat unseen_;
};

}  // namespace redbee
