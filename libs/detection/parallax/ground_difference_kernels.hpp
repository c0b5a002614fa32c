// Rows of the difference to earlier images, as vector code; ground_difference.hpp says what they are.
#pragma once

#include <cstdint>

namespace redbee {

/// Rows of an image, `width` px wide: mirrored beyond the border.
struct NeighbourRows {
  const uint8_t* above;
  const uint8_t* row;
  const uint8_t* below;
  int width;
};
struct SlopeVariance {
  float noise2;      ///< grey levels^2
  float per_square;  ///< of the squared length of Sobel's gradient
};
/// noise2 + per_square * slope^2 of the pixels [begin, end).
void varianceOfRow(const NeighbourRows& rows, const SlopeVariance& by, int begin, int end, float* variance);

struct ComparedRow {
  const uint8_t* now;
  const uint8_t* then;
  const uint8_t* unknown;
  const float* variance;
};
/// The lesser of `least` and 255 d^2 / (d^2 + variance), 0 where `unknown` is not 0, of [begin, end).
void keepLesser(const ComparedRow& row, int begin, int end, uint8_t* least);

}  // namespace redbee
