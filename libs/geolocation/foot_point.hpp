// Where in its box an object stands on the ground.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "redbee/geometry/camera_model.hpp"

namespace redbee {

/// A box in the raw image; `x`, `y` the first column and row, which are whole pixels.
struct ImageBox {
  double x = 0;  ///< px
  double y = 0;
  double width = 0;
  double height = 0;
  Eigen::Vector2d centre() const { return {x + (width - 1) / 2, y + (height - 1) / 2}; }
};

struct FootPoint {
  Eigen::Vector2d pixel;  ///< the middle of the object's place on the ground
  double along_px = 0;    ///< extent of the box along the vertical's direction in the image
  double across_px = 0;   ///< and across it
};

/// The vertical's direction at the box's centre is that of the image of a plumb line there. From the edge of
/// the box in that direction, the foot lies inwards by half of what the object covers on the ground: of an
/// object as long as l and as high as k l, seen under a depression e,
///     1/2 sin e / (sin e + k cos e)                                                                  (61)
/// of the extent: the very edge of what is seen from the side, the middle of what is seen from above.
/// `down`: unit, in the camera frame. std::nullopt if the camera does not see the box.
std::optional<FootPoint> footOf(const ImageBox& box, const CameraModel& camera, const Eigen::Vector3d& down,
                                double height_over_length);

}  // namespace redbee
