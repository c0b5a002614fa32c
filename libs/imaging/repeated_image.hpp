// Recorders and radio links fill gaps with the frame before, encoded once more.
#pragma once

#include <opencv2/core.hpp>

#include "redbee/geometry/time.hpp"

namespace redbee {

/// For so long an image may repeat an earlier one; one that still does so afterwards shows a still scene, or
/// a camera that hangs.
constexpr Duration kMaxRepetition = std::chrono::milliseconds(200);

/// True if the images, of one size, show the same moment: no block of 16x16 px of the full-size image differs
/// by more than encoding it twice explains. `downscale`: of the images. Sensor noise, and an object that
/// moves, differ by more.
bool repeats(const cv::Mat1b& image, const cv::Mat1b& earlier, int downscale);

}  // namespace redbee
