#include "redbee/geometry/homography_quality.hpp"

#include <Eigen/LU>
#include <cmath>

namespace redbee {
namespace {

constexpr double kMinDeterminant = 1e-6;
/// Of an entry, scaled. Beyond a thousand times half the image's width no prior helps anybody, and linearised
/// errors mean nothing.
constexpr double kMaxSigma = 1e3;

}  // namespace

bool isUsable(const Eigen::Matrix3d& H) {
  return H.allFinite() && std::abs(H(2, 2)) > 1e-9 && normaliseHomography(H).determinant() > kMinDeterminant;
}

bool isInformative(const Matrix8d& covariance) {
  return covariance.allFinite() && covariance.diagonal().maxCoeff() <= kMaxSigma * kMaxSigma;
}

}  // namespace redbee
