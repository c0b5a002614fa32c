// What a camera's calibration states: image size, pinhole parameters, lens model.
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
  /// As many as the model takes (camera_model.hpp); all zero or none for a camera without distortion.
  std::vector<double> distortion = std::vector<double>(5, 0.0);
  std::string model = "radtan";  ///< of the lens: a name that findCameraModel() knows
};

}  // namespace redbee
