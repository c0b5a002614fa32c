// How sharp an image is.
#pragma once

#include <opencv2/core.hpp>

namespace redbee {

/// Mean squared gradient [grey levels^2] of the half-size image in the direction with the smallest; 0 of an
/// empty one. Noise has little effect at half size, and motion blur affects one direction only.
double sharpnessOf(const cv::Mat1b& half);

}  // namespace redbee
