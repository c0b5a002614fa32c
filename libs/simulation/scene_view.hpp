// A scene as one camera sees it at one time; internal to the renderer.
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "redbee/geometry/camera.hpp"
#include "redbee/simulation/camera_pose.hpp"
#include "redbee/simulation/plane_view.hpp"
#include "redbee/simulation/scene.hpp"
#include "redbee/simulation/wave_field.hpp"

namespace redbee::simulation {

struct SceneView {
  double t_s;
  CameraPose pose;
  std::vector<PlaneView> planes;  ///< the ground's first, then the patches'
  std::vector<std::optional<WaveField>> waves;
};

SceneView viewOf(const Scene& scene, const CameraPose& pose, double t_s);

/// The scene at the time of each row, or of all of them.
class RowViews {
 public:
  explicit RowViews(std::vector<SceneView> views) : views_(std::move(views)) {}
  const SceneView& at(int row) const {
    return views_.size() == 1 ? views_.front() : views_[static_cast<size_t>(row)];
  }
  bool isOne() const { return views_.size() == 1; }

 private:
  std::vector<SceneView> views_;
};

/// What each pixel shows: kSurfaceGround, kSurfaceSky, or 1 + index of the patch in the scene. `rays`: x / z
/// and y / z.
cv::Mat1b nearestSurfaces(const Scene& scene, const Camera& camera, const cv::Mat_<cv::Vec2f>& rays,
                          const RowViews& rows);

/// 255 where the ground lies in the shadow of a patch. Empty without a sun.
cv::Mat1b groundShadows(const Scene& scene, const Camera& camera, const cv::Mat_<cv::Vec2f>& rays,
                        const RowViews& rows, const cv::Mat1b& surface);

}  // namespace redbee::simulation
