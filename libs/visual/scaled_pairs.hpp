// Point pairs in scaled coordinates (geometry/homography.hpp, ImageScaling).
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "redbee/geometry/homography.hpp"
#include "redbee/visual/point_tracker.hpp"

namespace redbee {

/// Structure of arrays, so that loops vectorise.
struct ScaledPairs {
  ScaledPairs() = default;
  ScaledPairs(const PointTracks& tracks, const ImageScaling& scaling);

  void reserve(std::size_t pairs) {
    for (auto* values : {&ax, &ay, &bx, &by}) values->reserve(pairs);
  }
  void append(float a_x, float a_y, float b_x, float b_y) {
    ax.push_back(a_x);
    ay.push_back(a_y);
    bx.push_back(b_x);
    by.push_back(b_y);
  }
  std::size_t size() const { return ax.size(); }
  Eigen::Vector2d previous(std::size_t i) const { return {ax[i], ay[i]}; }
  Eigen::Vector2d current(std::size_t i) const { return {bx[i], by[i]}; }

  std::vector<float> ax, ay, bx, by;
};

/// Squared transfer error of every pair into `squared`; huge where H maps a point to infinity or behind the
/// camera.
void squaredErrors(const ScaledPairs& pairs, const Eigen::Matrix3d& H, std::vector<float>& squared);

/// Sets `within` to 1 for each pair whose transfer error is at most `reach`, else to 0. Returns the number of
/// ones.
int flagInliers(const ScaledPairs& pairs, const Eigen::Matrix3d& H, double reach,
                std::vector<uint8_t>& within);

}  // namespace redbee
