#include "redbee/simulation/tracks.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "redbee/geometry/angle.hpp"
#include "redbee/geometry/homography.hpp"

namespace redbee::simulation {
namespace {

constexpr double kOutlierLow = 5, kOutlierHigh = 30;  // px off the true place

/// Column by column from the left, so that a fraction of the last ones is a connected region.
std::vector<Eigen::Vector2d> gridPoints(const TrackGrid& grid) {
  std::vector<Eigen::Vector2d> points;
  for (int x = grid.step / 2; x < grid.width; x += grid.step) {
    for (int y = grid.step / 2; y < grid.height; y += grid.step) points.emplace_back(x, y);
  }
  return points;
}

size_t fractionOf(size_t count, double fraction) {
  return static_cast<size_t>(std::llround(static_cast<double>(count) * std::clamp(fraction, 0.0, 1.0)));
}

void spoil(SimulatedTracks& tracks, size_t index, const Eigen::Matrix3d& H_ground,
           const Eigen::Matrix3d& H_other, std::mt19937& random) {
  std::uniform_real_distribution<double> length(kOutlierLow, kOutlierHigh), turns(0, 1);
  const Eigen::Vector2d ground = transfer(H_ground, tracks.before[index]);
  const Eigen::Vector2d other = transfer(H_other, tracks.before[index]);
  const Eigen::Vector2d place = tracks.origin[index] == TrackOrigin::kOther ? other : ground;
  do {
    const double radius = length(random), angle = kTurn * turns(random);
    tracks.after[index] = place + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  } while ((tracks.after[index] - ground).norm() < kOutlierLow ||
           (tracks.after[index] - other).norm() < kOutlierLow);
  tracks.origin[index] = TrackOrigin::kOutlier;
}

}  // namespace

SimulatedTracks simulateTracks(const Eigen::Matrix3d& H_ground, const Eigen::Matrix3d& H_other,
                               double other_fraction, double noise_px, double outlier_ratio,
                               const TrackGrid& grid, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  SimulatedTracks tracks;
  tracks.before = gridPoints(grid);
  const size_t count = tracks.before.size();
  const size_t first_other = count - fractionOf(count, other_fraction);
  for (size_t i = 0; i < count; ++i) {
    const bool is_other = i >= first_other;
    const double noise_x = noise_px * normal(random), noise_y = noise_px * normal(random);
    tracks.after.push_back(transfer(is_other ? H_other : H_ground, tracks.before[i]) +
                           Eigen::Vector2d(noise_x, noise_y));
    tracks.origin.push_back(is_other ? TrackOrigin::kOther : TrackOrigin::kGround);
  }
  std::vector<size_t> order(count);
  std::iota(order.begin(), order.end(), size_t{0});
  std::shuffle(order.begin(), order.end(), random);
  order.resize(fractionOf(count, outlier_ratio));
  for (const size_t index : order) spoil(tracks, index, H_ground, H_other, random);
  return tracks;
}

}  // namespace redbee::simulation
