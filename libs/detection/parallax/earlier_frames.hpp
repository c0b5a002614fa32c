// The latest images, each with the camera's motion from it to the current frame.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "redbee/geometry/homography.hpp"
#include "redbee/geometry/time.hpp"
#include "redbee/imaging/warping.hpp"

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

/// Warps an earlier image into the current view, for a scene of ground up to the horizon and infinite depth
/// above it.
class ImageAlignment {
 public:
  /// Keeps the image of `frame` (not copied). `K`: of the current image [px].
  ImageAlignment(const EarlierFrame& frame, const Eigen::Matrix3d& K);

  /// Pixels [begin, end) of row y of an image of the same size; `grey` and `unknown`: of the row, the latter
  /// 255 where the earlier image does not show the scene, else 0.
  void alignRow(int y, int begin, int end, uint8_t* grey, uint8_t* unknown);

 private:
  cv::Mat1b grey_;
  SceneMotion scene_;
  std::array<double, 9> ground_, far_;  ///< current to earlier, row by row
  std::vector<int32_t> places_;
};

/// An earlier image as a whole, by ImageAlignment.
struct AlignedImage {
  cv::Mat1b grey;
  cv::Mat1b unknown;  ///< 255 where the earlier image does not show the scene, or within margin_px of that
};
/// `K`: of the current image [px].
AlignedImage alignImage(const EarlierFrame& frame, const Eigen::Matrix3d& K, int margin_px);

}  // namespace redbee
