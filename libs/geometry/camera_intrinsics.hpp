// Intrinsic calibration of a camera: image size, pinhole parameters, lens model.
#pragma once

#include <string>
#include <vector>

namespace redbee {

/// Pixels have integer coordinates at their centres: the image spans [-0.5, width - 0.5].
struct CameraIntrinsics {
  int width = 0;   ///< px
  int height = 0;  ///< px
  double fx = 0;   ///< px
  double fy = 0;   ///< px
  double cx = 0;   ///< px
  double cy = 0;   ///< px
  /// As many coefficients as the model has (camera_model.hpp); all zero or empty for a camera without
  /// distortion.
  std::vector<double> distortion = std::vector<double>(5, 0.0);
  std::string model = "radtan";  ///< lens model: a name known to findCameraModel()
  /// s, from the exposure of one row to that of the row below; 0: global shutter. The middle row is exposed
  /// at the image's time (rolling_shutter.hpp).
  double line_delay_s = 0;
};

}  // namespace redbee
