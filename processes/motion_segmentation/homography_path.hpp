// The ground's homography between two frames, composed of what messages say about them and others.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "redbee/fused_homography_t.hpp"
#include "redbee/geometry/time.hpp"
#include "redbee/node/message_synchronizer.hpp"
#include "redbee/visual_homography_t.hpp"

namespace redbee {

/// From frame `from` to frame `to`.
struct HomographyLink {
  CameraTime from;
  CameraTime to;
  Eigen::Matrix3d H;
};

/// The links of fused homographies: steps, and from anchors (libs/README.md, equation 25). So a frame whose
/// own message was lost is linked by the next frame's, and frames that were missed are bridged.
std::vector<HomographyLink> linksOf(const MessageSynchronizer<fused_homography_t>& messages);
/// The links of vision's homographies.
std::vector<HomographyLink> linksOf(const MessageSynchronizer<visual_homography_t>& messages);

/// The homography along the fewest links, each taken in either direction, of several paths the one whose
/// links stand first; std::nullopt if there is no path.
std::optional<Eigen::Matrix3d> homographyAlong(const std::vector<HomographyLink>& links, CameraTime from,
                                               CameraTime to);

}  // namespace redbee
