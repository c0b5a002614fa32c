// The camera of a node: decodes and rectifies images.
#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "redbee/geometry/camera.hpp"
#include "redbee/image_t.hpp"
#include "redbee/imaging/image_row_motion.hpp"
#include "redbee/imaging/rectifier.hpp"
#include "redbee/node/health.hpp"

namespace redbee {

/// On the grid of the ideal camera, downscaled; both images empty if there is none.
struct IdealImage {
  cv::Mat1b grey;
  cv::Mat3b colour;   ///< BGR; empty unless requested
  Exposure exposure;  ///< that was taken out; as Rectifier::toRaw() wants it
};

class RectifiedCamera {
 public:
  /// `downscale`: 1, 2 or 4, of the images that ideal() returns; must divide width and height of the raw and
  /// of the ideal camera.
  /// `own_parts`: see Rectifier.
  explicit RectifiedCamera(const CameraIntrinsics& intrinsics, int downscale = 1,
                           const cv::Mat1b& own_parts = {});

  const Camera& camera() const { return camera_; }
  const Rectifier& rectifier() const { return rectifier_; }
  int downscale() const { return downscale_; }
  /// Empty for an image that is damaged (counted in `health`) or not of the raw camera's size. `measured`: at
  /// the image's time.
  IdealImage ideal(const image_t& message, bool wants_colour, HealthMonitor& health,
                   const Exposure& measured = {});

 private:
  Camera camera_;
  Rectifier rectifier_;
  int downscale_;
  ImageRowMotion row_motion_;
  Rectifier image_rectifier_;  ///< of the images that ideal() makes
};

}  // namespace redbee
