// Motion that no static surface at any depth explains (plane plus parallax; Irani and Anandan 1998;
// libs/README.md, "Parallax").
//
// An earlier image is aligned to the current one by the ground homography (above the horizon, where there is
// no ground, by the rotation). Does the dense flow that remains lie off the segment of possible parallax
// (parallax_segment.hpp)? The answer is averaged along what moves (travelling_evidence.hpp). It excludes
// trees and facades (without an IMU by their position, border_structure.hpp), but its outlines are coarse.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/video/tracking.hpp>
#include <optional>
#include <vector>

#include "redbee/detection/parallax/earlier_frames.hpp"
#include "redbee/detection/parallax/parallax_segment.hpp"
#include "redbee/detection/parallax/travelling_evidence.hpp"
#include "redbee/detection/parameters.hpp"
#include "redbee/geometry/homography.hpp"

namespace redbee {

/// Dense inverse-search flow for images of work_downscale, found at flow_downscale.
cv::Ptr<cv::DISOpticalFlow> makeMotionFlow(const ParallaxParameters& parameters);

class ParallaxEvidence {
 public:
  explicit ParallaxEvidence(const ParallaxParameters& parameters);

  void reset();
  /// The camera moves (previous to current; full-size pixels).
  void carry(const Eigen::Matrix3d& ground, const std::optional<Eigen::Matrix3d>& front,
             const std::optional<PlaneMotion>& motion);
  /// Evidence of motion per pixel of the work, 0..1; empty where there is no earlier frame. Stores the image
  /// (`full` or smaller).
  cv::Mat1f learn(int64_t utime, const cv::Mat1b& grey, const Eigen::Matrix3d& K, cv::Size full);

  /// 255 where the earlier frame of the last learn() does not show the scene; the work's pixels.
  const cv::Mat1b& unknown() const { return unknown_; }
  /// Flow of the last learn(); the work's pixels (see SurfaceSpeed). Empty where there was no
  /// earlier frame.
  const cv::Mat2f& speed() const { return speed_; }

 private:
  cv::Mat1f evidence(const EarlierFrame& frame, const cv::Mat1b& grey, const Eigen::Matrix3d& K,
                     double frames);
  FrameEvidence frameEvidence(const ParallaxSegment& segment, const cv::Mat1b& grey,
                              const cv::Mat1b& reference, const cv::Mat2f& flow, double frames);
  /// Whether much of the image moves so fast that the previous frame is a better reference than an earlier
  /// one.
  bool holdsFastMovers(const cv::Mat2f& flow, const cv::Mat2f& normalized_residual, double frames) const;
  void muteBorderStructure(cv::Mat1f& motion) const;
  cv::Mat1f flowVariance(const cv::Mat1b& grey) const;

  ParallaxParameters parameters_;
  double scale_;          ///< full-size pixels to a pixel of the work
  Eigen::Matrix3d work_;  ///< full-size pixels to the work's
  cv::Ptr<cv::DISOpticalFlow> dis_;
  EarlierFrames frames_;
  TravellingEvidence travelling_;
  Eigen::Matrix3d last_step_ = Eigen::Matrix3d::Identity();  ///< in the work's pixels
  bool fast_ = false;                                        ///< the last frame held fast movers
  cv::Mat1b unknown_;
  cv::Mat2f speed_;
};

}  // namespace redbee
