// Rows of the parallax evidence, as vector code. What they compute is stated by the scalar code:
// HomographyFlow::at(), ParallaxSegment::residual() and largestEigenvalue(); equation (28) of libs/README.md.
#pragma once

#include <cstddef>
#include <cstdint>

namespace redbee {

/// The flow of a homography close to the identity; HomographyFlow.
struct SmoothFlow {
  float middle[2];
  float unit;
  float affine[6];
  float perspective[2];
};

/// Of one row of pixels. Vectors are x and y alternating.
struct ResidualRow {
  int y;
  size_t width;
  const float* flow;      ///< px, from the current image to the earlier one
  const float* upper[3];  ///< covariance of the flow: FlowCovariance::Rows
  const float* lower[3];
  float upper_weight, lower_weight;
  const uint8_t* unknown;      ///< where it is not 0 there is no residual
  float* normalized_residual;  ///< 0 where unknown
  float* squared;  ///< its squared length, at most kMostSquaredResidual; kNotCompared where unknown
  float* nearest;  ///< ParallaxSegment::Residual::nearest
  float* speed;    ///< SurfaceSpeed
};
/// Bounded, so that few pixels of a wild flow do not make the mean of many.
inline constexpr float kMostSquaredResidual = 100;

/// For the segment of an epipole (homogeneous; 0 for none) whose direction has this variance [rad^2].
void residualRow(const SmoothFlow& error, const float epipole[3], float direction_variance,
                 const ResidualRow& row);

struct PropagationRow {
  int y;
  size_t width;
  const float* flow;         ///< px; times `step`: back by one frame
  const float* residual[3];  ///< normalized; of this row in the middle and its neighbours
  const float* previous;     ///< E, V (2) and L of the previous frame; null: 0
  int previous_rows;
  const uint8_t* unknown;
  int32_t* places;       ///< room for two rows
  double* sums;          ///< room for two rows and four more
  float* mean_residual;  ///< room for two rows
  float* moving;         ///< E, V, L
  float* motion;
};

struct Propagation {
  float step;
  float back[9];      ///< homography, current to previous
  float half2, rate;  ///< of the evidence
  float motion_half2;
};

void propagateRow(const Propagation& by, const PropagationRow& row);

}  // namespace redbee
