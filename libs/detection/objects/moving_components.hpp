// Components made of points whose paths no static surface explains (parallax/moving_points.hpp).
#pragma once

#include <opencv2/core.hpp>

#include "redbee/detection/objects/components.hpp"
#include "redbee/detection/parameters.hpp"

namespace redbee {

/// Part of the image [px] that addMovingComponents() may change; empty if nothing moves.
cv::Rect movingPart(const cv::Mat1f& moving, cv::Size image, int closing_px);

/// Adds the regions of `maps.moving` that no component covers: P_FG is low there, because the object is too
/// small or too slow for the dense flow of one baseline. Where one covers them, its gain rises. `unknown`: as
/// of findComponents().
void addMovingComponents(ForegroundComponents& found, const cv::Mat1b& unknown,
                         const ObjectParameters& parameters, const ComponentMaps& maps);

}  // namespace redbee
