// Draws the detections on an image.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "redbee/detection/detector.hpp"
#include "redbee/geometry/time.hpp"

namespace redbee {

struct OverlayStatus {
  CameraTime time{};
  double fps = 0;      ///< frames per second; 0: not shown
  std::string source;  ///< of the homography: "fused", "inertial", ...
  int32_t epoch = 0;
  std::string message;  ///< anything else, such as "learning"
};

/// `image`: 8-bit grey, or BGR, which is drawn on. `mask`: 0/255 of the same size, or empty. Returns the BGR
/// image with the mask's tint and outline, a box with the identity per detection (grey if the tracker only
/// predicted it in this frame), and the status in the top line.
cv::Mat3b drawOverlay(cv::Mat image, const cv::Mat1b& mask, const std::vector<Detection>& detections,
                      const OverlayStatus& status);

}  // namespace redbee
