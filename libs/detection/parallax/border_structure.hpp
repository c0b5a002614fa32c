// Trees and facades without an IMU: their parallax is like motion, but they extend beyond the image's border,
// which moving objects seldom do over a long stretch.
#pragma once

#include <opencv2/core.hpp>

namespace redbee {

/// Fraction of the evidence of motion that is connected to the image's border: at each pixel the highest
/// level at which a path leads to a stretch of the border at least `stretch_px` long without ever falling
/// below that level (grey-scale reconstruction; Vincent 1993), over the evidence itself. 0..1, of
/// `motion`'s size. `motion`: 0..1; `unknown`: 255 where it is undefined: the border is that of the defined
/// part.
cv::Mat1f fractionOfBorderStructure(const cv::Mat1f& motion, const cv::Mat1b& unknown, double stretch_px);

}  // namespace redbee
