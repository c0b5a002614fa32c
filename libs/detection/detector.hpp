// The interface of all detectors of moving objects: ours, the paper's and the rivals. A new one is a class
// behind it and a line in detector_factory.cpp. Assigning a cv::Mat shares its memory: images of a FrameInput
// must not be modified, a detector may keep them, and those of its DetectorOutput: change a copy.
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
#include "redbee/geometry/time.hpp"
#include "redbee/visual/point_tracker.hpp"

namespace redbee {

/// Which parts of a FrameInput a detector uses; the rest may stay empty.
struct DetectorNeeds {
  bool colour = false;
  bool camera_motion = false;  ///< ground, front, motion and tracks
  /// The images may be smaller than FrameInput::size by this factor (1, 2 or 4).
  int image_downscale = 1;
};

/// One frame. Images and points are undistorted (ideal pixels).
struct FrameInput {
  CameraTime time_previous{};  ///< frame that ground, front, motion and tracks start from
  CameraTime time{};
  cv::Size size;     ///< image size of homographies, points and output; empty: grey's
  cv::Mat1b grey;    ///< empty if the image is damaged
  cv::Mat3b colour;  ///< BGR, of grey's size; may be empty unless the detector needs it
  Eigen::Matrix3d K = Eigen::Matrix3d::Identity();  ///< camera matrix of an image of `size` [px]
  /// The same of the previous frame, where the lens zooms.
  std::optional<Eigen::Matrix3d> K_previous;
  std::optional<Eigen::Matrix3d> ground;  ///< homography previous to current [px]
  std::optional<Eigen::Matrix3d> front;   ///< the same of the front plane; std::nullopt if there is none
  std::optional<PlaneMotion> motion;      ///< of the camera, from an IMU: rotation, translation, plane
  cv::Mat1b own_parts;  ///< 255 where images show the vehicle itself, or nothing (of a rolling
                        ///< shutter beyond the border); of `size`, or empty
  PointTracks tracks;   ///< tracked sample points, for the entropy of the flow
  int sample_grid_px = TrackerParameters{}.grid_px;  ///< px between the sample points

  CameraPair cameras() const { return {K_previous.value_or(K), K}; }
  cv::Size fullSize() const { return size.empty() ? grey.size() : size; }
};

enum class DetectorStatus {
  kGood,
  kLearning,      ///< the background is not known yet: all pixels are unknown, the mask is empty
  kNoHomography,  ///< the camera's motion is unknown: the background restarts
  kBadImage,      ///< damaged, black, blank or frozen for long: not learned, the mask is empty
};
const char* toString(DetectorStatus status);

/// Images of FrameInput's full size. The detector may keep them: who changes one changes a copy.
struct DetectorOutput {
  CameraTime time{};
  DetectorStatus status = DetectorStatus::kLearning;
  cv::Mat1b probability;  ///< P_FG * 255
  cv::Mat1b mask;         ///< 0 or 255; of ours, what the seen detections consist of
  cv::Mat1b unknown;      ///< 255 where no earlier frame shows the scene; the mask is 0 there
  std::vector<Detection> detections;

  /// Nothing is known: all pixels are unknown, the mask is empty.
  static DetectorOutput empty(CameraTime time, cv::Size size, DetectorStatus status) {
    return {time, status, cv::Mat1b::zeros(size), cv::Mat1b::zeros(size), cv::Mat1b(size, 255), {}};
  }
};

class Detector {
 public:
  virtual ~Detector() = default;

  virtual DetectorNeeds needs() const = 0;
  /// Processes the next frame. A gap in time, a frame that comes again or late, or a change of size restarts
  /// the background (see the status); identities are kept if possible.
  virtual DetectorOutput step(const FrameInput& input) = 0;
};

/// Constructs the detector `parameters.method`. Throws std::invalid_argument for a name that is not in
/// detectorNames().
std::unique_ptr<Detector> makeDetector(const DetectionParameters& parameters);
/// In alphabetical order.
std::vector<std::string> detectorNames();

}  // namespace redbee
