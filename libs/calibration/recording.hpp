// The input of a calibration on a common time scale, reduced to what the estimators use.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "redbee/calibration/calibration.hpp"
#include "redbee/calibration/imu_history.hpp"
#include "redbee/calibration/joint_problem.hpp"
#include "redbee/calibration/rotation_alignment.hpp"

namespace redbee::calibration {

/// Correspondences between two frames (indices), and their homography.
struct IndexedMatch {
  size_t a = 0;
  size_t b = 0;
  const PointTracks* points = nullptr;
};

/// Frames on which the IMU and vision overlap without a gap. Shares the IMU and the correspondences with the
/// input.
struct Recording {
  std::shared_ptr<const ImuHistory> imu;
  std::shared_ptr<const Camera> camera;
  std::vector<double> t_cam_s;  ///< increasing, since the first frame of the input
  std::vector<IndexedMatch> matches;
  std::vector<GroundHomography> ground;
  std::vector<TargetPose> target;
  std::vector<HeightObservation> heights;

  bool hasTarget() const { return !target.empty(); }
};

/// Throws CalibrationError if the input is insufficient.
Recording prepareRecording(const CalibrationInput& input);
/// Frames [begin, end) alone.
Recording partOf(const Recording& whole, size_t begin, size_t end);
/// The camera's rotation between frames, for alignRotations.
std::vector<RotationObservation> rotationsOf(const Recording& recording);

}  // namespace redbee::calibration
