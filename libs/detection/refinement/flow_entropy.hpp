// Entropy of the flow's direction per cell (paper, equation 12): low on objects, high on waves and leaves.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "redbee/detection/parameters.hpp"
#include "redbee/visual/point_tracker.hpp"

namespace redbee {

/// Entropy [bits] of a histogram; 0 for an empty one.
double histogramEntropy(const std::vector<int>& histogram);

/// Reciprocal entropy of the flow's direction per cell of entropy_cell_points^2 sample points, after the
/// ground's motion has been taken out: floor / max(entropy, floor), in (0, 1], of the image's size.
/// `sample_grid_px`: px between the sample points. Points that moved less than flow_noise_px are not counted.
/// A cell with tracks but no counted point gets the smallest value, that of a uniform histogram; a cell
/// without tracks gets 1.
cv::Mat1f flowOrder(const PointTracks& tracks, int sample_grid_px, const Eigen::Matrix3d& ground,
                    cv::Size image, const RefinementParameters& parameters);

}  // namespace redbee
