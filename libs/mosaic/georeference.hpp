// Where a map of the ground lies, from places that are known on both.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace redbee {

/// A point of the ground, as the homographies and as the vehicle's poses have it.
struct GroundTie {
  Eigen::Vector2d on_map;  ///< seen from above: x to the right, y downwards (ground_chain.hpp)
  Eigen::Vector2d place;   ///< m, east and north
  double sigma_m = 1;      ///< of `place`, one standard deviation along each axis
};

struct Georeference {
  /// m, east and north of a point on the map: its y axis turns round, so the determinant is negative.
  Eigen::Matrix2d turn_and_scale;
  Eigen::Vector2d offset;
  double scale = 1;       ///< m per unit of the map
  double residual_m = 0;  ///< root mean square of what the ties differ by, each weighted by its variance

  Eigen::Vector2d placeOf(const Eigen::Vector2d& on_map) const { return turn_and_scale * on_map + offset; }
};

/// The similarity of least squares, in closed form (Umeyama 1991, in the plane). std::nullopt unless the ties
/// lie at two places at least.
std::optional<Georeference> georeference(const std::vector<GroundTie>& ties);

}  // namespace redbee
