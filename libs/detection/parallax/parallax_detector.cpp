#include "redbee/detection/parallax/parallax_detector.hpp"

#include <algorithm>

namespace redbee {

ParallaxDetector::ParallaxDetector(const DetectionParameters& parameters)
    : GroundDetector(parameters), evidence_(parameters.parallax, parameters.appearance, parameters.shadow) {
  needs_.colour = true;
  needs_.camera_motion = true;
  // All processing is on smaller images, and a JPEG is decoded faster into one.
  needs_.image_downscale = parameters.parallax.work_downscale;
  if (parameters.appearance.enabled) {
    needs_.image_downscale = std::min(needs_.image_downscale, parameters.appearance.downscale);
  }
}

void ParallaxDetector::warpBackground(const FrameInput& input) {
  const bool is_structure =
      input.front && runsOutOfImage(input.tracks, *input.ground, *input.front, input.fullSize());
  evidence_.propagate(*input.ground, is_structure ? input.front : std::nullopt, input.motion,
                      input.cameras());
}

ForegroundMaps ParallaxDetector::learn(const FrameInput& input) {
  return evidence_.learn(input.time, input.grey, input.colour, input.K, input.fullSize(), input.own_parts);
}

}  // namespace redbee
