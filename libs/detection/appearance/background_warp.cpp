#include "redbee/detection/appearance/background_warp.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>

#include "redbee/detection/appearance/background_warp_kernels.hpp"

namespace redbee {
namespace {

Eigen::Vector2f source(const Eigen::Matrix3f& back, int x, int y) {
  return (back * Eigen::Vector3f(static_cast<float>(x), static_cast<float>(y), 1)).hnormalized();
}

/// Pixels begin to end of row y, which `back` maps into the earlier image. Source coordinates are
/// interpolated linearly over a run: over so few pixels the perspective error is below 0.001 px.
void warpRow(const WarpedMaps& maps, const Eigen::Matrix3f& back, int y, int begin, int end,
             BackgroundMaps& to) {
  for (int x = begin; x < end; x += kWarpRun) {
    const int next = std::min(x + kWarpRun, end);
    const Eigen::Vector2f first = source(back, x, y);
    const Eigen::Vector2f step = (source(back, next, y) - first) / static_cast<float>(next - x);
    warpRun(maps, {first.x(), first.y(), step.x(), step.y(), next - x, to.model.ptr<float>(y) + 4 * x,
                   to.speed[y] + x, to.age[y] + x});
  }
}

}  // namespace

void warpBackground(const BackgroundMaps& maps, const SceneMotion& scene, BackgroundMaps& to) {
  const Eigen::Matrix3f ground = scene.ground.inverse().cast<float>();
  const Eigen::Matrix3f far = scene.far.inverse().cast<float>();
  const cv::Size size = maps.model.size();
  to.model.create(size);
  to.speed.create(size);
  to.age.create(size);
  const WarpedMaps from{size.width, size.height, maps.model.ptr<float>(), maps.speed[0], maps.age[0]};
  for (int y = 0; y < size.height; ++y) {
    const SceneMotion::HorizonCut cut = scene.cutAtHorizon(y, size.width);
    warpRow(from, cut.ground_first ? ground : far, y, 0, cut.at, to);
    warpRow(from, cut.ground_first ? far : ground, y, cut.at, size.width, to);
  }
}

}  // namespace redbee
