// Warps the maps of the background model into the current view: a step of AppearanceModel.
#pragma once

#include <opencv2/core.hpp>

#include "redbee/imaging/warping.hpp"

namespace redbee {

struct BackgroundMaps {
  cv::Mat4f model;  ///< interpolated linearly
  cv::Mat1f speed;  ///< of the nearest pixel
  cv::Mat1b age;    ///< of the nearest pixel; 0 outside of the previous view
};

/// For a scene of ground up to the horizon and infinite depth above it.
BackgroundMaps warpBackground(const BackgroundMaps& maps, const SceneMotion& scene);

}  // namespace redbee
