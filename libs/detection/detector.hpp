// The seam between a frame and what moves in it: every detector, ours, the paper's and the rivals, is a class
// behind this interface and a line in detector_factory.cpp.
//
// Images share their memory when they are assigned (OpenCV): nobody writes to an image of a FrameInput, a
// detector may keep one, and a DetectorOutput belongs to the caller.
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

/// Which parts of a FrameInput a detector uses; the rest may stay empty.
struct DetectorNeeds {
  bool colour = false;
  bool camera_motion = false;  ///< ground, front, motion and tracks
  /// The images may be this much smaller than FrameInput::size (1, 2 or 4); 1: they have that size.
  int image_downscale = 1;
};

/// One frame. Images and points are undistorted (ideal pixels).
struct FrameInput {
  int64_t utime_previous = 0;  ///< us, of the frame that ground, front, motion and tracks start from
  int64_t utime = 0;           ///< us
  cv::Size size;               ///< of the image that homographies, points and output are of; empty: grey's
  cv::Mat1b grey;              ///< empty if the image is damaged
  cv::Mat3b colour;            ///< BGR, of grey's size; may be empty unless the detector needs it
  Eigen::Matrix3d K = Eigen::Matrix3d::Identity();  ///< camera matrix of an image of `size` [px]
  std::optional<Eigen::Matrix3d> ground;            ///< homography previous to current [px]
  std::optional<Eigen::Matrix3d> front;             ///< the front plane's; std::nullopt if there is none
  std::optional<PlaneMotion> motion;  ///< of the camera, from an IMU: rotation, translation, plane
  PointTracks tracks;                 ///< sample points, for the flow's entropy
  int sample_grid_px = TrackerParameters{}.grid_px;  ///< px between the sample points

  cv::Size fullSize() const { return size.empty() ? grey.size() : size; }
};

enum class DetectorStatus {
  kGood,
  kLearning,      ///< the background is not known yet: everything is "unknown", the mask is empty
  kNoHomography,  ///< the camera's motion to this frame is not known: the background restarts
  kBadImage,      ///< damaged, black, blank or frozen: nothing was learned from it, the mask is empty
};
const char* toString(DetectorStatus status);

/// Images of FrameInput's full size.
struct DetectorOutput {
  int64_t utime = 0;
  DetectorStatus status = DetectorStatus::kLearning;
  cv::Mat1b probability;  ///< P_FG * 255
  cv::Mat1b mask;         ///< 0 or 255
  cv::Mat1b unknown;      ///< 255 where no earlier frame shows the background (there the mask is 0)
  std::vector<Detection> detections;
};

class Detector {
 public:
  virtual ~Detector() = default;

  virtual DetectorNeeds needs() const = 0;
  /// Frames in order of time. A gap in time, a repeated or earlier frame, or a change of size restarts the
  /// background (see the status); identities survive where they can.
  virtual DetectorOutput step(const FrameInput& input) = 0;
};

/// Constructs the detector that `parameters.method` names, and no other. Throws std::invalid_argument for a
/// name that is none of detectorNames().
std::unique_ptr<Detector> makeDetector(const DetectionParameters& parameters);
/// In alphabetical order.
std::vector<std::string> detectorNames();

}  // namespace redbee
