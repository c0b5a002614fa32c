// Rows of the appearance model, as vector code: equation (29) of libs/README.md and what is learned. Images
// and model are interleaved: blue, green, red, and a fourth that is unused in images and the variance in the
// model.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace redbee {

/// Sums over three neighbours, mirrored at the border: image squared, image times background, background
/// squared.
struct ShadowSums {
  float* pp;
  float* pb;
  float* bb;
};
/// `products`: room for three times `width` floats.
void sumShadowRow(const float* image, const float* background, size_t width, float* products,
                  const ShadowSums& sums);
/// 0 (no shadow) to 1 of each pixel, by the sums of its row and of those above and below.
void scoreShadowRow(const ShadowSums rows[3], size_t width, float noise_variance, float* shadow);

/// Confidence that the modelled surface has moved away.
struct SurfaceReset {
  bool is_used;
  float sigmas2;
};

struct DifferenceRow {
  size_t width;
  const float* image;
  const float* model[3];  ///< the row above, this one, the one below; at the border this one again
  const float* shadow;
  const float* speed;  ///< SurfaceSpeed
  const float* learned_speed;
  const uint8_t* age;
  float* difference;
};
void differenceRow(const DifferenceRow& row, float noise2, float edge2, const SurfaceReset& reset);

using RatesByAge = std::array<float, 256>;
struct LearningRow {
  size_t width;
  const float* image;
  const float* moving;
  const float* speed;
  float* model;
  float* learned_speed;
  uint8_t* age;
};
void learnRow(const LearningRow& row, const RatesByAge& mean_rates, const RatesByAge& variance_rates,
              const SurfaceReset& reset);

}  // namespace redbee
