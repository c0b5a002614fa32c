// Parts of the robust estimation: the minimal solution and least squares. Everything here is in scaled
// coordinates (geometry/homography.hpp, ImageScaling).
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "redbee/geometry/homography.hpp"
#include "redbee/visual/scaled_pairs.hpp"

namespace redbee {

/// The homography through four pairs (Hartley and Zisserman, 2nd ed., 4.1.1, by way of the projective basis);
/// std::nullopt if three points are nearly collinear or the pairs flip the quadrilateral's orientation, which
/// is impossible for a plane seen from one side.
std::optional<Eigen::Matrix3d> homographyThroughFour(const ScaledPairs& pairs,
                                                     const std::array<std::size_t, 4>& sample);

struct LeastSquares {
  Eigen::Matrix3d H;
  Matrix8d inverse_information;  ///< (J' W J)^-1
  double variance =
      0;  ///< per coordinate; variance * inverse_information is the covariance for independent errors
};

/// Prior on the homography, weighted against the pairs' squared residuals.
struct FitPrior {
  Vector8d mean;
  Matrix8d information;  ///< inverse covariance, times the variance of a residual
};

/// Levenberg's method on the transfer errors of the chosen pairs, Huber weights with knee `knee`.
/// std::nullopt if the pairs do not determine eight parameters.
std::optional<LeastSquares> fitHomography(const ScaledPairs& pairs, const std::vector<uint8_t>& chosen,
                                          const Eigen::Matrix3d& start, double knee, int iterations,
                                          const FitPrior* prior = nullptr);

}  // namespace redbee
