// Exact point trajectories of two rigid motions.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <random>
#include <vector>

#include "redbee/geometry/so3.hpp"

namespace redbee::test {

inline constexpr Eigen::Index kTrajectoryFrames = 8;
inline constexpr Eigen::Index kEach = 40;

/// Points of a rotating and translating body of 1.6 m size at 5 m distance; f = 500 px, perspective or affine
/// projection.
inline Eigen::MatrixXd bodyTrajectories(std::mt19937& random, const Eigen::Vector3d& centre,
                                        const Eigen::Vector3d& turn, const Eigen::Vector3d& travel,
                                        bool perspective) {
  std::uniform_real_distribution<double> within(-0.8, 0.8);
  Eigen::MatrixXd X(2 * kTrajectoryFrames, kEach);
  for (Eigen::Index i = 0; i < kEach; ++i) {
    const Eigen::Vector3d point(within(random), within(random), within(random));
    for (Eigen::Index f = 0; f < kTrajectoryFrames; ++f) {
      const auto t = static_cast<double>(f);
      const Eigen::Vector3d at = expSO3(t * turn) * point + centre + t * travel;
      const double depth = perspective ? at.z() : centre.z();
      X.block<2, 1>(2 * f, i) = 500 * at.head<2>() / depth;
    }
  }
  return X;
}

/// 2F x N, the first kEach columns of the first motion.
inline Eigen::MatrixXd twoMotions(bool perspective) {
  std::mt19937 random(7);
  Eigen::MatrixXd X(2 * kTrajectoryFrames, 2 * kEach);
  X << bodyTrajectories(random, {-1, 0, 5}, {0.03, 0.05, 0.02}, {0.02, 0.01, 0.05}, perspective),
      bodyTrajectories(random, {1, 0.2, 5}, {-0.04, 0.02, -0.05}, {-0.03, 0.04, -0.06}, perspective);
  return X;
}

/// Scaled so that the largest entry is 1.
inline Eigen::MatrixXd unit(const Eigen::MatrixXd& X) { return X / X.cwiseAbs().maxCoeff(); }

/// Fraction of labels that separate the two motions correctly.
inline double rightFraction(const std::vector<int>& labels) {
  double same = 0;
  for (size_t i = 0; i < labels.size(); ++i) same += labels[i] == (i < kEach ? 0 : 1) ? 1 : 0;
  const double fraction = same / static_cast<double>(labels.size());
  return std::max(fraction, 1 - fraction);
}

}  // namespace redbee::test
