#include "redbee/visual/scaled_pairs.hpp"

#include <stdexcept>

namespace redbee {
namespace {

/// Squared transfer error of one pair.
inline float squaredError(const ScaledPairs& pairs, const Eigen::Matrix3f& h, std::size_t i) {
  constexpr float kFar = 1e6F;
  const float x = pairs.ax[i], y = pairs.ay[i];
  const float w = h(2, 0) * x + h(2, 1) * y + h(2, 2);
  const float depth = w > 1e-6F ? w : 1e-6F;
  const float ex = (h(0, 0) * x + h(0, 1) * y + h(0, 2)) / depth - pairs.bx[i];
  const float ey = (h(1, 0) * x + h(1, 1) * y + h(1, 2)) / depth - pairs.by[i];
  return w > 1e-6F ? ex * ex + ey * ey : kFar;
}

}  // namespace

ScaledPairs::ScaledPairs(const PointTracks& tracks, const ImageScaling& scaling) {
  if (tracks.previous.size() != tracks.current.size())
    throw std::invalid_argument("tracks of unequal length");
  const auto scaleX = [&](float x) { return static_cast<float>(scaling.T(0, 0) * x + scaling.T(0, 2)); };
  const auto scaleY = [&](float y) { return static_cast<float>(scaling.T(1, 1) * y + scaling.T(1, 2)); };
  reserve(tracks.previous.size());
  for (std::size_t i = 0; i < tracks.previous.size(); ++i) {
    append(scaleX(tracks.previous[i].x), scaleY(tracks.previous[i].y), scaleX(tracks.current[i].x),
           scaleY(tracks.current[i].y));
  }
}

void squaredErrors(const ScaledPairs& pairs, const Eigen::Matrix3d& H, std::vector<float>& squared) {
  const Eigen::Matrix3f h = H.cast<float>();
  squared.resize(pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) squared[i] = squaredError(pairs, h, i);
}

int flagInliers(const ScaledPairs& pairs, const Eigen::Matrix3d& H, double reach,
                std::vector<uint8_t>& within) {
  const Eigen::Matrix3f h = H.cast<float>();
  const auto limit = static_cast<float>(reach * reach);
  within.resize(pairs.size());
  int count = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    within[i] = squaredError(pairs, h, i) <= limit ? 1 : 0;
    count += within[i];
  }
  return count;
}

}  // namespace redbee
