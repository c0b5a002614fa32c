// Pose of a known target from its corners in one image.
#pragma once

#include <optional>

#include "redbee/calibration/calibration.hpp"
#include "redbee/calibration/joint_problem.hpp"

namespace redbee::calibration {

/// Least squares over the corners' reprojection errors (Huber), with its information from the residuals. The
/// frame's index is not set. std::nullopt with fewer than eight corners or if they do not fit a pose.
std::optional<TargetPose> estimateTargetPose(const Camera& camera, const TargetView& given);

}  // namespace redbee::calibration
