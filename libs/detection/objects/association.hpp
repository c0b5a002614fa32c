// Which component belongs to which track.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "redbee/detection/objects/box_filter.hpp"
#include "redbee/detection/objects/components.hpp"

namespace redbee {

/// A component's box as a measurement of its object's. Edges at the image's border are left open.
BoxMeasurement measurementOf(const Component& component, cv::Size image);

/// Several components of one object as one.
Component joined(const std::vector<Component>& all, const std::vector<size_t>& parts);

/// Minimum-cost assignment over 1 - IoU of predicted and measured box, both grown by the predicted position's
/// sigma. Pairs beyond the gate of the innovation covariance, or with hardly an overlap, are none. Returns
/// the component of each track, an element of `candidates`, or kUnassigned.
std::vector<int> associate(const std::vector<const BoxFilter*>& tracks,
                           const std::vector<Component>& components, const std::vector<size_t>& candidates,
                           cv::Size image);

}  // namespace redbee
