// The epipole without an IMU. After the ground's motion is compensated, the residual flow of all static
// surfaces lies on lines through one point, whatever the focal length (plane plus parallax; Irani and Anandan
// 1998).
#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "redbee/detection/parallax/flow_covariance.hpp"
#include "redbee/detection/parallax/registration_error.hpp"

namespace redbee {

/// What the epipole is estimated from, between an earlier frame and the current one.
struct EpipoleInput {
  cv::Mat2f flow;         ///< px, from the current image to the earlier one aligned to it
  FlowCovariance noise;   ///< px^2, of the flow
  cv::Mat1b unknown;      ///< not 0 where the flow is undefined
  HomographyFlow error;   ///< of the alignment, earlier image to current one
  cv::Matx33d ground;     ///< homography of the ground, earlier frame to current one [px]
  cv::Matx33d K;          ///< camera matrix [px]; its focal length may be a guess
  cv::Matx33d K_earlier;  ///< the same of the earlier image, where the lens may have had another zoom
};

/// Robust fit (RANSAC, then least squares) to the residual flow. Moving objects may have an epipole of their
/// own: only one in the direction that the ground's homography says the camera travelled in is accepted, and
/// only while the surfaces that agree on it are spread over the image, on average over time. No epipole is an
/// answer.
class EpipoleEstimator {
 public:
  void reset() { support_ = {}; }
  /// Epipole (homogeneous, px), scaled so that a static surface at ground position g has moved by 0 to 1
  /// times e_12 - e_3 g; std::nullopt if there is none. `elapsed_s`: since the last call.
  std::optional<cv::Vec3f> update(const EpipoleInput& input, double elapsed_s);

 private:
  /// Mean fraction of the image that agrees on one epipole, 0..1.
  struct Support {
    double mean = 0;
    int frames = 0;
  };
  Support support_;
};

}  // namespace redbee
