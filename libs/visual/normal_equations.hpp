// Gauss-Newton's normal equations of a homography's transfer errors, Huber weights. Scaled coordinates
// (geometry/homography.hpp, ImageScaling).
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "redbee/geometry/homography.hpp"
#include "redbee/visual/scaled_pairs.hpp"

namespace redbee {

struct NormalEquations {
  Matrix8d information = Matrix8d::Zero();
  Vector8d gradient = Vector8d::Zero();
  double cost = 0;               ///< Huber
  double influence_squares = 0;  ///< sum of (w r)^2
  double weights = 0;            ///< sum of w
  double slopes = 0;             ///< sum of the influence function's slope, mean of the two directions
};

/// The chosen pairs, packed so that four are processed at once.
class PackedPairs {
 public:
  PackedPairs(const ScaledPairs& pairs, const std::vector<uint8_t>& chosen);

  int size() const { return size_; }
  /// About the homography `H` (h33 = 1); `knee`: residual beyond which a pair's influence is constant.
  NormalEquations linearise(const Eigen::Matrix3d& H, double knee) const;

 private:
  int size_ = 0;
  ScaledPairs pairs_;          ///< padded to a multiple of four with pairs of weight 0
  std::vector<float> counts_;  ///< weight: 1, or 0 for padding
};

}  // namespace redbee
