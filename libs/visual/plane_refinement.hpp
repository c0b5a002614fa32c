// Refinement of RANSAC's plane: least squares on all inliers, and the covariance of the result.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "redbee/visual/homography_estimation.hpp"
#include "redbee/visual/scaled_pairs.hpp"

namespace redbee {

/// kFromStart: only the pairs near the initial plane are fitted; selecting inliers again (kFollowsFit) could
/// drift from the predicted ground to a larger plane nearby.
enum class Selection { kFollowsFit, kFromStart };

/// Of the pairs only those that are `allowed` may be inliers. `start`: scaled. std::nullopt if the minima of
/// the parameters are not reached.
std::optional<HomographyEstimate> refinePlane(const ScaledPairs& pairs, const std::vector<uint8_t>& allowed,
                                              const Eigen::Matrix3d& start, cv::Size image,
                                              const RansacParameters& parameters, Selection selection);

}  // namespace redbee
