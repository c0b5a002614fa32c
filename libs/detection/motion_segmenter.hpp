// From the planes' homographies to moving objects (paper III.A and III.B; libs/README.md, "Foreground and
// objects").
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "redbee/detection/objects/object_tracker.hpp"
#include "redbee/detection/parameters.hpp"
#include "redbee/geometry/homography.hpp"
#include "redbee/visual/point_tracker.hpp"

namespace redbee {

enum class SegmentationStatus {
  kGood,
  kLearning,      ///< the background is not known yet: everything is "unknown", the mask is empty
  kNoHomography,  ///< the camera's motion to this frame is not known: the background restarts
  kBadImage,      ///< black, blank or frozen: nothing was learned from it, the mask is empty
};
const char* toString(SegmentationStatus status);

/// Input of the segmentation for one frame. Images and points are undistorted (ideal pixels).
struct SegmentationInput {
  int64_t utime_previous = 0;
  int64_t utime = 0;
  cv::Size size;   ///< of the image that homographies, points and answer are of; empty: grey's
  cv::Mat grey;    ///< CV_8U; kParallax: may be smaller than `size`, as the work and the background are
  cv::Mat colour;  ///< CV_8UC3 (BGR) of the same image; may be empty
  Eigen::Matrix3d K = Eigen::Matrix3d::Identity();  ///< camera matrix, for `motion`
  std::optional<Eigen::Matrix3d> ground;            ///< homography previous to current
  std::optional<Eigen::Matrix3d> front;             ///< the front plane's; nothing where there is none
  std::optional<PlaneMotion> motion;  ///< of the camera, from an IMU: rotation, translation, plane
  PointTracks tracks;                 ///< sample points, for the flow's entropy
};

struct SegmentationOutput {
  int64_t utime = 0;
  SegmentationStatus status = SegmentationStatus::kLearning;
  cv::Mat probability;  ///< CV_8U, P_FG * 255
  cv::Mat mask;         ///< CV_8U, 0 or 255
  cv::Mat unknown;      ///< CV_8U, 255 where no earlier frame shows the background (there the mask is 0)
  std::vector<Detection> detections;
};

class MotionSegmenter {
 public:
  explicit MotionSegmenter(const SegmentationParameters& parameters);
  ~MotionSegmenter();

  /// Frames in order of time. A gap in utime_previous / utime, a repeated or earlier frame, or a change of
  /// size restarts the background (see the status); identities survive where they can.
  SegmentationOutput step(const SegmentationInput& input);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace redbee
