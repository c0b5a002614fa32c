// What fused homographies say about the camera's motion between two frames that need not be neighbours.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "redbee/fused_homography_t.hpp"
#include "redbee/geometry/homography.hpp"
#include "redbee/geometry/time.hpp"
#include "redbee/node/message_synchronizer.hpp"
#include "redbee/visual/point_tracker.hpp"

namespace redbee {

/// The members of FrameInput that have these names; ideal pixels.
struct FrameStep {
  Eigen::Matrix3d ground;
  std::optional<Eigen::Matrix3d> front;
  std::optional<PlaneMotion> motion;
  PointTracks tracks;
};

/// First `before`, then `last`. The tracks are those of `last`, each from where the plane that explains it
/// better had its point before: of an object they show the motion of the last step.
FrameStep composed(const FrameStep& before, FrameStep last);

/// Frame `from` to frame `to`, composed of the steps between them; std::nullopt if one is missing.
std::optional<FrameStep> stepAlong(const MessageSynchronizer<fused_homography_t>& messages, CameraTime from,
                                   CameraTime to);

}  // namespace redbee
