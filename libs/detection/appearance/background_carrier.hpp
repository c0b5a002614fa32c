// Resampling of the carried background for a moved camera: a step of CarriedBackground.
#pragma once

#include <opencv2/core.hpp>

#include "redbee/imaging/warping.hpp"

namespace redbee {

struct BackgroundMaps {
  cv::Mat4f model;  ///< interpolated between pixels
  cv::Mat1f speed;  ///< of the nearest pixel
  cv::Mat1b age;    ///< of the nearest pixel; 0 outside of the previous view
};

/// The maps warped into the current view: ground up to the horizon, infinitely far above it.
BackgroundMaps carryBackground(const BackgroundMaps& maps, const SceneMotion& scene);

}  // namespace redbee
