// Evidence of motion by plane plus parallax (Irani and Anandan 1998; libs/README.md, "Parallax").
//
// An earlier image is aligned to the current one by the ground homography (above the horizon by the
// rotation). The distance of the residual dense flow from the parallax segment (parallax_segment.hpp) is
// evidence of motion, which is averaged along the flow (propagated_evidence.hpp). Static surfaces at any
// depth, such as trees and facades, are excluded (without an IMU by border_structure.hpp), but outlines are
// coarse.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "redbee/detection/parallax/earlier_frames.hpp"
#include "redbee/detection/parallax/epipole.hpp"
#include "redbee/detection/parallax/flow_comparison.hpp"
#include "redbee/detection/parallax/parallax_segment.hpp"
#include "redbee/detection/parallax/point_paths.hpp"
#include "redbee/detection/parallax/propagated_evidence.hpp"
#include "redbee/detection/parameters.hpp"
#include "redbee/geometry/homography.hpp"
#include "redbee/geometry/time.hpp"
#include "redbee/imaging/inverse_search.hpp"

namespace redbee {

/// Dense flow for images at work_downscale, computed at flow_downscale.
InverseSearch makeMotionFlow(const ParallaxParameters& parameters);

class ParallaxEvidence {
 public:
  explicit ParallaxEvidence(const ParallaxParameters& parameters);

  void reset();
  /// From the next image on: false leaves out what `use_point_paths` asks for.
  void followPoints(bool wanted);
  /// Propagates the stored images and evidence by the camera's motion (previous to current; full-size
  /// pixels).
  void propagate(const Eigen::Matrix3d& ground, const std::optional<Eigen::Matrix3d>& front,
                 const std::optional<PlaneMotion>& motion);
  /// Evidence of motion, 0..1, at work_downscale; empty if there is no earlier frame. Stores the image (of
  /// size `full` or smaller).
  /// `own_parts`: see FrameInput; unknown where they are and where they were.
  cv::Mat1f learn(CameraTime time, const cv::Mat1b& grey, const Eigen::Matrix3d& K, cv::Size full,
                  const cv::Mat1b& own_parts, SpareMaps& spare);

  /// 255 where the reference frame of the last learn() does not show the scene; at work_downscale.
  const cv::Mat1b& unknown() const { return unknown_; }
  /// movingRegion() of the last learn(), at work_downscale; empty where no point moves. `difference`: of
  /// appearance, 0..1, of any size.
  cv::Mat1f movingRegion(const cv::Mat1f& difference) const;
  /// The image of the last learn(), at work_downscale. Precondition: one.
  const cv::Mat1b& image() const { return frames_.newest()->grey; }
  /// SurfaceSpeed of the last learn(), at work_downscale; empty if there was no earlier frame.
  const cv::Mat2f& speed() const { return speed_; }
  /// ForegroundMaps::residual of the last learn(), at work_downscale; empty if there was no earlier frame.
  const cv::Mat1f& residual() const { return residual_; }
  /// photometricGain() of the last learn() where this P_FG, 0..1, may be an object's; at work_downscale.
  /// Empty without an earlier frame, without a direction of travel (static surfaces may be anywhere then), or
  /// if photometric_noise is 0.
  cv::Mat1f photometricGain(const cv::Mat1f& foreground);

 private:
  void leaveOutOwnParts(const EarlierFrame& frame, const Eigen::Matrix3d& K);
  cv::Mat1f evidence(const EarlierFrame& frame, const cv::Mat1b& grey, const Eigen::Matrix3d& K,
                     double frames, SpareMaps& spare);
  /// By the epipole, or else by the front plane. `error`: of the registration without parallax.
  std::optional<ParallaxSegment> segmentWithoutMotion(const EarlierFrame& frame, const Eigen::Matrix3d& K,
                                                      const cv::Mat2f& flow, const FlowCovariance& noise,
                                                      const HomographyFlow& error);
  HomographyFlow registration(const cv::Mat2f& flow, const FlowCovariance& noise,
                              const ParallaxSegment& segment) const;
  FlowComparison comparison(const EarlierFrame& frame, const cv::Mat1b& grey, const cv::Mat1b& earlier,
                            const Eigen::Matrix3d& K);
  void suppressBorderStructure(cv::Mat1f& motion) const;

  ParallaxParameters parameters_;
  bool follows_points_;
  double scale_;          ///< full-size pixels per pixel at work_downscale
  Eigen::Matrix3d work_;  ///< full-size pixels to those at work_downscale
  InverseSearch search_;
  EarlierFrames frames_;
  EpipoleEstimator epipole_;
  PropagatedEvidence propagated_;
  PointPaths paths_;
  Eigen::Matrix3d last_step_ = Eigen::Matrix3d::Identity();  ///< pixels at work_downscale
  double elapsed_s_ = 0;                                     ///< between the last two frames
  bool fast_ = false;                                        ///< the last frame had fast movers
  cv::Mat1b own_parts_;                                      ///< at work_downscale; empty: none
  cv::Mat1b unknown_;
  cv::Mat2f speed_;
  cv::Mat1f residual_;
  std::optional<FlowComparison> compared_;
};

}  // namespace redbee
