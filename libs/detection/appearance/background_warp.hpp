// Warps the maps of the background model into the current view: a step of AppearanceModel.
#pragma once

#include <opencv2/core.hpp>

#include "redbee/imaging/warping.hpp"

namespace redbee {

struct BackgroundMaps {
  cv::Mat4f model;  ///< mean colour (3, grey levels), variance (per channel); interpolated linearly
  cv::Mat1f speed;  ///< px: speed of the surface that the model was learned from; of the nearest pixel
  cv::Mat1b age;    ///< number of images learned from, at most 255; of the nearest pixel, 0 outside of the
                    ///< previous view
};

/// For a scene of ground up to the horizon and infinite depth above it. `to` is written over, and must not
/// share memory with `maps`.
void warpBackground(const BackgroundMaps& maps, const SceneMotion& scene, BackgroundMaps& to);

}  // namespace redbee
