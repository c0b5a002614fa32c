// Where on the ground there has been foreground lately: what moves to and fro about one place is no object.
// libs/README.md, (39).
#pragma once

#include <Eigen/Core>
#include <deque>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "redbee/detection/objects/components.hpp"

namespace redbee {

/// The boxes of the latest 5 s, each in the pixels of its own frame.
class PlaceHistory {
 public:
  /// To the next frame. `ground`: homography, previous to current [px]; what was before an unknown step is
  /// forgotten.
  void propagate(double elapsed_s, const std::optional<Eigen::Matrix3d>& ground);
  /// What was found in the current frame.
  void note(const std::vector<Component>& components);
  /// How long, of the latest 5 s before the current frame, something covered the place on the ground that
  /// the centre of a box shows, while the object in the box, at its present velocity over the ground [px/s],
  /// had not arrived there yet [s].
  double occupiedBefore(const cv::Rect2d& box, const Eigen::Vector2d& velocity) const;

 private:
  struct Frame {
    double age_s;
    double duration_s;  ///< since the frame before
    Eigen::Matrix3d from_current;
    std::vector<cv::Rect> boxes;
  };

  double duration_s_ = 0;     ///< of the current frame
  std::deque<Frame> frames_;  ///< oldest first
};

}  // namespace redbee
