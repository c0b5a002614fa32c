// Where a patch is sampled between the pixels of an image.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>

#include "redbee/imaging/pyramid.hpp"
#include "redbee/visual/lanes.hpp"
#include "redbee/visual/patch_alignment.hpp"

namespace redbee {

/// std::lround(), which is a call.
inline int32_t rounded(double value) { return static_cast<int32_t>(value + std::copysign(0.5, value)); }

/// Where a patch's top left pixel and its bilinear weights lie for a centre between pixels.
struct SamplePlace {
  SamplePlace(const PyramidLevel& level, const Eigen::Vector2d& centre, int half) {
    const double floor_x = std::floor(centre.x());
    const double floor_y = std::floor(centre.y());
    const double fx = centre.x() - floor_x;
    const double fy = centre.y() - floor_y;
    constexpr int kOne = 1 << BilinearWeights::kWeightBits;
    const auto fixed = [](double w) { return static_cast<int16_t>(rounded(w * kOne)); };
    weights.top_left = fixed((1 - fx) * (1 - fy));
    weights.top_right = fixed(fx * (1 - fy));
    weights.bottom_left = fixed((1 - fx) * fy);
    weights.bottom_right =
        static_cast<int16_t>(kOne - weights.top_left - weights.top_right - weights.bottom_left);
    corner = level.at(static_cast<int>(floor_x) - half, static_cast<int>(floor_y) - half);
  }
  const uint8_t* corner;
  BilinearWeights weights{};
};

/// Whether a patch's samples lie in the level and its margin.
inline bool isNear(const PyramidLevel& level, const Eigen::Vector2d& centre) {
  const double reach = PatchShape::kOverhang - 1;
  // Written so that a NaN is not near.
  return centre.x() >= -reach && centre.y() >= -reach && centre.x() <= level.width - 1 + reach &&
         centre.y() <= level.height - 1 + reach;
}

}  // namespace redbee
