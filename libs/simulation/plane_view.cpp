#include "redbee/simulation/plane_view.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace redbee::simulation {
namespace {

bool insidePerson(float across, float down) {
  const float head_x = across / 0.42F, head_y = (down - 0.08F) / 0.08F;
  if (head_x * head_x + head_y * head_y <= 1) return true;
  if (down > 0.16F && down < 0.58F) return std::abs(across) < 1 - 0.5F * (down - 0.16F);
  return down >= 0.58F && down <= 1 && std::abs(across) > 0.08F && std::abs(across) < 0.75F;
}

}  // namespace

PlaneView viewOf(const Eigen::Vector3d& origin, const Eigen::Vector3d& axis_u, const Eigen::Vector3d& axis_v,
                 const CameraPose& pose) {
  const Eigen::Vector3d normal = axis_u.cross(axis_v);
  const Eigen::Vector3d offset = pose.p_GC - origin;
  const double distance = -normal.dot(offset);
  if (distance == 0) return {Eigen::Vector3f::Zero(), Eigen::Vector3f::Zero(), Eigen::Vector3f::Zero()};
  const Eigen::Vector3d Q = pose.R_CG * normal / distance;
  return {(axis_u.dot(offset) * Q + pose.R_CG * axis_u).cast<float>(),
          (axis_v.dot(offset) * Q + pose.R_CG * axis_v).cast<float>(), Q.cast<float>()};
}

bool insideShape(PatchShape shape, float x, float y) {
  if (std::abs(x) > 1 || std::abs(y) > 1) return false;
  if (shape == PatchShape::kEllipse) return x * x + y * y <= 1;
  if (shape == PatchShape::kPerson) return insidePerson(x, (y + 1) / 2);
  return true;
}

Eigen::Vector3d centreAt(const Patch& patch, double t_s) {
  return patch.centre + patch.motion.displacementAt(t_s);
}

cv::Rect boxOf(const Patch& patch, const CameraPose& pose, double t_s, const Camera& camera) {
  const cv::Rect all(0, 0, camera.intrinsics().width, camera.intrinsics().height);
  if (camera.isDistorted()) return all;
  Eigen::Vector2d low(1e6, 1e6), high(-1e6, -1e6);
  for (const double u : {-0.5, 0.5}) {
    for (const double v : {-0.5, 0.5}) {
      const Eigen::Vector3d corner =
          centreAt(patch, t_s) + u * patch.width_m * patch.axis_u + v * patch.height_m * patch.axis_v;
      const Eigen::Vector3d X = pose.R_CG * (corner - pose.p_GC);
      if (X.z() < 0.05) return all;
      const Eigen::Vector2d pixel = (camera.K() * X).hnormalized();
      low = low.cwiseMin(pixel);
      high = high.cwiseMax(pixel);
    }
  }
  low = low.cwiseMax(-1e5);
  high = high.cwiseMin(1e5);
  const cv::Point first(static_cast<int>(std::floor(low.x())), static_cast<int>(std::floor(low.y())));
  const cv::Point beyond(static_cast<int>(std::ceil(high.x())) + 1,
                         static_cast<int>(std::ceil(high.y())) + 1);
  return all & cv::Rect(first, beyond);
}

}  // namespace redbee::simulation
