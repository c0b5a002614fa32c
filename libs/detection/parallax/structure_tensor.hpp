// The structure tensor of an image (Foerstner and Guelch 1987), and the covariance of what is matched there:
// along an edge a displacement is not observed (aperture problem).
#pragma once

#include <functional>
#include <opencv2/core.hpp>

namespace redbee {

/// A symmetric 2x2 matrix: xx, xy, yy.
using Symmetric2f = cv::Vec3f;

float largestEigenvalue(const Symmetric2f& S);
/// Not below 0.
float smallestEigenvalue(const Symmetric2f& S);
/// S^-1/2 of a positive definite S, symmetric.
Symmetric2f inverseRoot(const Symmetric2f& S);

inline cv::Vec2f operator*(const Symmetric2f& S, const cv::Vec2f& v) {
  return {S[0] * v[0] + S[1] * v[1], S[1] * v[0] + S[2] * v[1]};
}

/// S: mean of g g' over a window around each pixel, g the gradient [grey levels per px]; mirrored beyond the
/// border. `window_px`: odd, at most 45.
cv::Mat3f structureTensor(const cv::Mat1b& grey, int window_px);
/// The same a row at a time, from the top: visit(y, row), which holds for the call.
void forEachTensorRow(const cv::Mat1b& grey, int window_px,
                      const std::function<void(int, const Symmetric2f*)>& visit);

/// variance (I + min_gradient2 S^-1): `variance` over good texture, twice as much along a gradient of the
/// root of `min_gradient2`.
Symmetric2f displacementCovariance(const Symmetric2f& S, float variance, float min_gradient2);
/// Of all pixels. `covariances`: of the tensors' size.
void displacementCovariances(const cv::Mat3f& tensors, float variance, float min_gradient2,
                             cv::Mat3f& covariances);

}  // namespace redbee
