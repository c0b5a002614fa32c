// Recognises static structures without an IMU: the parallax of trees and facades resembles motion, but unlike
// moving objects they usually touch a long stretch of the image's border.
#pragma once

#include <opencv2/core.hpp>

namespace redbee {

/// Fraction of the evidence of motion that is connected to the image's border: the evidence reconstructed
/// from stretches of the border at least `stretch_px` long (grey-scale reconstruction; Vincent 1993), over
/// the evidence itself. 0..1, of `motion`'s size. `motion`: 0..1; `unknown`: 255 where it is undefined; the
/// border is that of the defined part.
cv::Mat1f fractionOfBorderStructure(const cv::Mat1f& motion, const cv::Mat1b& unknown, double stretch_px);

}  // namespace redbee
