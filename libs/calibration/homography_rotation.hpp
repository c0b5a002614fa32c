// The camera's rotation from a homography of an unknown plane.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace redbee::calibration {

/// Rotation of the camera between two frames a, b, as far as one homography determines it. All are rotation
/// vectors [rad] of R_CaCb, in the camera frame.
struct RotationCandidates {
  /// Rotation closest to K^-1 H K: biased by half the cross product of translation / height and normal, but
  /// unique.
  Eigen::Vector3d rough;
  /// The physically possible rotations (Malis and Vargas 2007): up to two; one if the camera did not move.
  std::vector<Eigen::Vector3d> exact;
};

/// H_ba in ideal pixels.
RotationCandidates rotationsFromHomography(const Eigen::Matrix3d& K, const Eigen::Matrix3d& H_ba);

}  // namespace redbee::calibration
