// Planes and patches as one camera sees them; internal to the renderer.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "redbee/geometry/camera.hpp"
#include "redbee/simulation/camera_pose.hpp"
#include "redbee/simulation/scene.hpp"

namespace redbee::simulation {

/// A plane as one camera sees it. For a ray d: inverse depth q = Q d, surface coordinates u = (U d) / q, v =
/// (V d) / q.
struct PlaneView {
  Eigen::Vector3f U, V, Q;
};

/// All zero, which no ray intersects, for a plane through the camera's centre.
PlaneView viewOf(const Eigen::Vector3d& origin, const Eigen::Vector3d& axis_u, const Eigen::Vector3d& axis_v,
                 const CameraPose& pose);

/// Patch coordinates relative to its half width and half height, -1 to 1.
bool insideShape(const Patch& patch, float x, float y);

/// Where a patch is at one time, in G [m].
struct PatchPose {
  Eigen::Vector3d centre, axis_u, axis_v;
};
/// `seen_from`: in G [m], what a round patch faces.
PatchPose patchPose(const Patch& patch, double t_s, const Eigen::Vector3d& seen_from);

/// Bounding box of a patch in the image; the whole image if a corner lies behind the camera.
cv::Rect boxOf(const Patch& patch, const CameraPose& pose, double t_s, const Camera& camera);
/// Of these points in G [m].
cv::Rect boxOf(const std::vector<Eigen::Vector3d>& points, const CameraPose& pose, const Camera& camera);

}  // namespace redbee::simulation
