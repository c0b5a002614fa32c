#include "redbee/simulation/plane_view.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "redbee/geometry/angle.hpp"

namespace redbee::simulation {
namespace {

bool insidePerson(float across, float down) {
  const float head_x = across / 0.42F, head_y = (down - 0.08F) / 0.08F;
  if (head_x * head_x + head_y * head_y <= 1) return true;
  if (down > 0.16F && down < 0.58F) return std::abs(across) < 1 - 0.5F * (down - 0.16F);
  return down >= 0.58F && down <= 1 && std::abs(across) > 0.08F && std::abs(across) < 0.75F;
}

/// Periodic noise of mean 0 and deviation 1 that is smooth over `cell` texels.
class Noise {
 public:
  Noise(double cell, int seed) : map_(kSize, kSize) {
    cv::RNG random(static_cast<uint64_t>(seed));
    random.fill(map_, cv::RNG::NORMAL, 0, 1);
    const int margin = static_cast<int>(4 * cell);
    cv::Mat wrapped;
    cv::copyMakeBorder(map_, wrapped, margin, margin, margin, margin, cv::BORDER_WRAP);
    cv::GaussianBlur(wrapped, wrapped, {}, cell);
    cv::Scalar mean, deviation;
    const cv::Mat inner = wrapped(cv::Rect(margin, margin, kSize, kSize));
    cv::meanStdDev(inner, mean, deviation);
    map_ = (inner - mean[0]) / deviation[0];
  }
  float at(float x, float y) const {
    const auto index = [](float value) { return static_cast<int>(std::floor(value)) & (kSize - 1); };
    return map_(index(y), index(x));
  }

 private:
  static constexpr int kSize = 512;
  cv::Mat1f map_;
};

/// A crown's outline is uneven, and the sky shines through it.
bool insideFoliage(const Patch& patch, float x, float y) {
  constexpr float kLeaf_m = 0.06F, kEdge = 0.3F, kGaps = -0.75F;
  static const Noise leaves(1.6, 1), outline(6, 2);
  const auto along =
      static_cast<float>(37 * patch.centre.x() + 91 * patch.centre.y() + 53 * patch.centre.z());
  const float edge = outline.at(20 * x + along, 20 * y - along);
  if (x * x + y * y > 0.75F + kEdge * std::min(edge, 0.8F)) return false;
  const auto half_width = static_cast<float>(patch.width_m / 2),
             half_height = static_cast<float>(patch.height_m / 2);
  return leaves.at(x * half_width / kLeaf_m - along, y * half_height / kLeaf_m + along) > kGaps;
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

bool insideShape(const Patch& patch, float x, float y) {
  if (std::abs(x) > 1 || std::abs(y) > 1) return false;
  switch (patch.shape) {
    case PatchShape::kEllipse:
      return x * x + y * y <= 1;
    case PatchShape::kPerson:
      return insidePerson(x, (y + 1) / 2);
    case PatchShape::kTriangle:
      return std::abs(x) <= (y + 1) / 2;
    case PatchShape::kFoliage:
      return insideFoliage(patch, x, y);
    case PatchShape::kRectangle:
      break;
  }
  return true;
}

PatchPose patchPose(const Patch& patch, double t_s, const Eigen::Vector3d& seen_from) {
  PatchPose pose{patch.centre + patch.motion.displacementAt(t_s), patch.axis_u, patch.axis_v};
  if (patch.sway) {
    const Sway& sway = *patch.sway;
    pose.centre += sway.amplitude_m * std::sin(kTurn * sway.frequency_hz * t_s + sway.phase_rad);
  }
  if (patch.swing) {
    const Swing& swing = *patch.swing;
    const double moved_s = patch.motion.movingTime(t_s);
    const double angle =
        swing.amplitude_rad * std::sin(kTurn * swing.frequency_hz * moved_s + swing.phase_rad);
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, swing.axis).toRotationMatrix();
    const Eigen::Vector3d to_pivot = -patch.height_m / 2 * pose.axis_v;
    pose.centre += to_pivot - turn * to_pivot;
    pose.axis_u = turn * pose.axis_u;
    pose.axis_v = turn * pose.axis_v;
  }
  if (patch.is_round) {
    const Eigen::Vector3d across = pose.axis_v.cross(seen_from - pose.centre);
    if (across.norm() > 1e-6) pose.axis_u = across.normalized();
  }
  return pose;
}

cv::Rect boxOf(const std::vector<Eigen::Vector3d>& points, const CameraPose& pose, const Camera& camera) {
  const cv::Rect all(0, 0, camera.intrinsics().width, camera.intrinsics().height);
  if (camera.isDistorted()) return all;
  Eigen::Vector2d low(1e6, 1e6), high(-1e6, -1e6);
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector3d X = pose.R_CG * (point - pose.p_GC);
    if (X.z() < 0.05) return all;
    const Eigen::Vector2d pixel = (camera.K() * X).hnormalized();
    low = low.cwiseMin(pixel);
    high = high.cwiseMax(pixel);
  }
  low = low.cwiseMax(-1e5);
  high = high.cwiseMin(1e5);
  const cv::Point first(static_cast<int>(std::floor(low.x())), static_cast<int>(std::floor(low.y())));
  const cv::Point beyond(static_cast<int>(std::ceil(high.x())) + 1,
                         static_cast<int>(std::ceil(high.y())) + 1);
  return all & cv::Rect(first, beyond);
}

cv::Rect boxOf(const Patch& patch, const CameraPose& pose, double t_s, const Camera& camera) {
  const PatchPose at = patchPose(patch, t_s, pose.p_GC);
  std::vector<Eigen::Vector3d> corners;
  for (const double u : {-0.5, 0.5}) {
    for (const double v : {-0.5, 0.5})
      corners.emplace_back(at.centre + u * patch.width_m * at.axis_u + v * patch.height_m * at.axis_v);
  }
  return boxOf(corners, pose, camera);
}

}  // namespace redbee::simulation
