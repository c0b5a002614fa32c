#include "redbee/simulation/scene_view.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "redbee/simulation/renderer.hpp"

namespace redbee::simulation {
namespace {

constexpr float kHorizonInverseDepth = 1e-3F;  // 1/m: ground farther away than this is sky
constexpr double kFarAway_m = 1e5;
constexpr double kLift_m = 0.05;  // what lies lower is part of the ground

Eigen::Vector3f rayAt(const cv::Mat_<cv::Vec2f>& rays, int y, int x) {
  return {rays(y, x)[0], rays(y, x)[1], 1};
}

bool isOnGround(const Patch& patch) {
  return patch.kind != PatchKind::kMover && patch.centre.z() < kLift_m && std::abs(patch.normal().z()) > 0.99;
}

/// Box of a patch in the image: the whole image with a rolling shutter.
cv::Rect boxIn(const Patch& patch, const Camera& camera, const cv::Mat_<cv::Vec2f>& rays,
               const RowViews& rows) {
  if (!rows.isOne()) return {0, 0, rays.cols, rays.rows};
  return boxOf(patch, rows.at(0).pose, rows.at(0).t_s, camera);
}

void layGround(const cv::Mat_<cv::Vec2f>& rays, const RowViews& rows, cv::Mat1b& surface,
               cv::Mat1f& inverse_depth) {
  for (int y = 0; y < rays.rows; ++y) {
    const PlaneView& view = rows.at(y).planes.front();
    for (int x = 0; x < rays.cols; ++x) {
      const float q = view.Q.dot(rayAt(rays, y, x));
      surface(y, x) = q > kHorizonInverseDepth ? kSurfaceGround : kSurfaceSky;
      inverse_depth(y, x) = std::max(q, kHorizonInverseDepth);
    }
  }
}

/// The shadow of one patch on the ground, by the line from each point of the ground to the sun.
class Shadow {
 public:
  Shadow(const Patch& patch, double t_s, const Eigen::Vector3d& sun)
      : patch_(patch), at_(patchPose(patch, t_s, patch.centre + kFarAway_m * sun)), sun_(sun) {
    normal_ = at_.axis_u.cross(at_.axis_v);
    along_ = normal_.dot(sun);
  }

  /// Its corners, on the ground. Empty if the patch is seen edge-on, or lies on the ground, and casts none.
  std::vector<Eigen::Vector3d> outline() const {
    constexpr double kLeast = 1e-3;
    std::vector<Eigen::Vector3d> corners;
    if (std::abs(along_) < kLeast) return corners;
    double highest_m = 0;
    for (const double u : {-0.5, 0.5}) {
      for (const double v : {-0.5, 0.5}) {
        const Eigen::Vector3d corner =
            at_.centre + u * patch_.width_m * at_.axis_u + v * patch_.height_m * at_.axis_v;
        highest_m = std::max(highest_m, corner.z());
        corners.emplace_back(corner - std::max(corner.z(), 0.0) / sun_.z() * sun_);
      }
    }
    if (highest_m < kLift_m) corners.clear();
    return corners;
  }

  bool covers(const Eigen::Vector3d& ground) const {
    const Eigen::Vector3d offset = ground - at_.centre;
    const double distance = -normal_.dot(offset) / along_;
    if (distance <= 0) return false;
    const Eigen::Vector3d hit = offset + distance * sun_;
    return insideShape(patch_, static_cast<float>(2 * at_.axis_u.dot(hit) / patch_.width_m),
                       static_cast<float>(2 * at_.axis_v.dot(hit) / patch_.height_m));
  }

 private:
  const Patch& patch_;
  PatchPose at_;
  Eigen::Vector3d sun_, normal_;
  double along_;
};

Eigen::Vector3d onGround(const SceneView& view, const Eigen::Vector3f& ray) {
  const PlaneView& ground = view.planes.front();
  const float depth = 1 / ground.Q.dot(ray);
  return {static_cast<double>(ground.U.dot(ray) * depth), static_cast<double>(ground.V.dot(ray) * depth), 0};
}

void castShadow(const Patch& patch, const Eigen::Vector3d& sun, const Camera& camera,
                const cv::Mat_<cv::Vec2f>& rays, const RowViews& rows, const cv::Mat1b& surface,
                const std::vector<bool>& is_ground, cv::Mat1b& shadows) {
  std::optional<Shadow> shadow;
  cv::Rect box(0, 0, rays.cols, rays.rows);
  if (rows.isOne()) {
    shadow.emplace(patch, rows.at(0).t_s, sun);
    const std::vector<Eigen::Vector3d> outline = shadow->outline();
    if (outline.empty()) return;
    box = boxOf(outline, rows.at(0).pose, camera);
  }
  for (int y = box.y; y < box.br().y; ++y) {
    const SceneView& view = rows.at(y);
    if (!rows.isOne()) {
      shadow.emplace(patch, view.t_s, sun);
      if (shadow->outline().empty()) continue;
    }
    for (int x = box.x; x < box.br().x; ++x) {
      if (shadows(y, x) != 0 || !is_ground[surface(y, x)]) continue;
      if (shadow->covers(onGround(view, rayAt(rays, y, x)))) shadows(y, x) = 255;
    }
  }
}

}  // namespace

SceneView viewOf(const Scene& scene, const CameraPose& pose, double t_s) {
  SceneView view{t_s, pose, {}, std::vector<std::optional<WaveField>>(scene.patches.size() + 1)};
  view.planes.push_back(
      viewOf(Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), pose));
  for (size_t i = 0; i < scene.patches.size(); ++i) {
    const Patch& patch = scene.patches[i];
    const PatchPose at = patchPose(patch, t_s, pose.p_GC);
    view.planes.push_back(viewOf(at.centre, at.axis_u, at.axis_v, pose));
    if (patch.waving) view.waves[i + 1].emplace(*patch.waving, t_s);
  }
  return view;
}

cv::Mat1b nearestSurfaces(const Scene& scene, const Camera& camera, const cv::Mat_<cv::Vec2f>& rays,
                          const RowViews& rows) {
  cv::Mat1b surface(rays.size());
  cv::Mat1f inverse_depth(rays.size());
  layGround(rays, rows, surface, inverse_depth);
  for (size_t i = 0; i < scene.patches.size(); ++i) {
    const Patch& patch = scene.patches[i];
    const cv::Rect box = boxIn(patch, camera, rays, rows);
    const auto half_width = static_cast<float>(patch.width_m / 2),
               half_height = static_cast<float>(patch.height_m / 2);
    for (int y = box.y; y < box.br().y; ++y) {
      const PlaneView& view = rows.at(y).planes[i + 1];
      for (int x = box.x; x < box.br().x; ++x) {
        const Eigen::Vector3f ray = rayAt(rays, y, x);
        const float q = view.Q.dot(ray);
        if (q <= inverse_depth(y, x)) continue;
        if (!insideShape(patch, view.U.dot(ray) / (q * half_width), view.V.dot(ray) / (q * half_height)))
          continue;
        surface(y, x) = static_cast<uchar>(i + 1);
        inverse_depth(y, x) = q;
      }
    }
  }
  return surface;
}

cv::Mat1b groundShadows(const Scene& scene, const Camera& camera, const cv::Mat_<cv::Vec2f>& rays,
                        const RowViews& rows, const cv::Mat1b& surface) {
  if (!scene.sun) return {};
  std::vector<bool> is_ground(256, false);
  is_ground[kSurfaceGround] = true;
  for (size_t i = 0; i < scene.patches.size(); ++i) is_ground[i + 1] = isOnGround(scene.patches[i]);
  cv::Mat1b shadows = cv::Mat1b::zeros(surface.size());
  for (const Patch& patch : scene.patches)
    castShadow(patch, *scene.sun, camera, rays, rows, surface, is_ground, shadows);
  return shadows;
}

}  // namespace redbee::simulation
