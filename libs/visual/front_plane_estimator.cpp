#include "redbee/visual/front_plane_estimator.hpp"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "redbee/geometry/homography.hpp"
#include "redbee/geometry/median.hpp"
#include "redbee/visual/scaled_pairs.hpp"

namespace redbee {

FrontPlaneParameters::FrontPlaneParameters() {
  ransac.min_inliers = 40;
  ransac.min_inlier_ratio = 0.3;
  ransac.min_spread = 0.05;
}

std::optional<HomographyEstimate> FrontPlaneEstimator::estimate(const PointTracks& tracks,
                                                                const Eigen::Matrix3d& ground) const {
  const ImageScaling scaling(width_, height_);
  std::vector<uint8_t> unexplained;
  flagInliers(ScaledPairs(tracks, scaling), scaling.scale(ground), parameters_.ground_px / scaling.unit_px,
              unexplained);
  for (uint8_t& flag : unexplained) flag = flag ? 0 : 1;
  auto front = estimateHomographyAmong(tracks, unexplained, width_, height_, parameters_.ransac);
  if (!front) return std::nullopt;

  std::vector<double> separations;
  for (std::size_t i = 0; i < front->inlier.size(); ++i) {
    if (!front->inlier[i]) continue;
    const Eigen::Vector2d p(tracks.previous[i].x, tracks.previous[i].y);
    separations.push_back((transfer(front->H, p) - transfer(ground, p)).norm());
  }
  if (median(std::move(separations)) < parameters_.min_separation_px) return std::nullopt;
  return front;
}

}  // namespace redbee
