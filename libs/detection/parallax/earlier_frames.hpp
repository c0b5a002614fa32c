// The latest images, each with the camera's motion from it to the current frame.
#pragma once

#include <cstdint>
#include <deque>
#include <opencv2/core.hpp>
#include <optional>

#include "redbee/geometry/homography.hpp"
#include "redbee/geometry/time.hpp"

namespace redbee {

struct EarlierFrame {
  CameraTime time{};
  cv::Mat1b grey;
  Eigen::Matrix3d K = Eigen::Matrix3d::Identity();       ///< of its image [px]
  Eigen::Matrix3d ground = Eigen::Matrix3d::Identity();  ///< this frame's pixels to the current frame's
  std::optional<PlaneMotion> motion;                     ///< from this frame to the current one
  std::optional<Eigen::Matrix3d> front;                  ///< the same of the front plane
  bool still = true;                                     ///< no propagate() since: the motion is the identity
};

class EarlierFrames {
 public:
  void reset() { frames_.clear(); }
  /// Adds the camera's motion to all frames (previous to current, pixels of the stored images).
  void propagate(const Eigen::Matrix3d& ground, const std::optional<PlaneMotion>& motion,
                 const std::optional<Eigen::Matrix3d>& front = std::nullopt);
  /// Stores an image (not copied) and erases those older than span_s.
  void store(CameraTime time, const cv::Mat1b& grey, const Eigen::Matrix3d& K, double span_s);
  /// The frame whose age is closest to age_s; nullptr if there is none.
  const EarlierFrame* aged(CameraTime now, double age_s) const;
  const EarlierFrame* newest() const { return frames_.empty() ? nullptr : &frames_.back(); }

 private:
  std::deque<EarlierFrame> frames_;  ///< oldest first
};

/// An earlier image warped into the current view, for a scene of ground up to the horizon and infinite depth
/// above it.
struct AlignedImage {
  cv::Mat1b grey;
  cv::Mat1b unknown;  ///< 255 where the earlier image does not show the scene, or within margin_px of that
};
/// `K`: of the current image [px].
AlignedImage alignImage(const EarlierFrame& frame, const Eigen::Matrix3d& K, int margin_px);

}  // namespace redbee
