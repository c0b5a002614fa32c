// The template of the patch alignment where the processor has vectors of 32 bytes: two rows at once. All sums
// are exact.
#pragma once

#include <cstddef>
#include <cstdint>

namespace redbee {

/// A patch and where it is stored, row by row in `lanes` groups of eight: grey levels and differences of the
/// neighbours, twice the gradient. `mask`: of one row, all bits set inside the patch.
struct TemplateRows {
  int side, lanes;
  const int16_t* mask;
  int16_t* grey;
  int16_t* gradient_x;
  int16_t* gradient_y;
};

/// Over the patch: of grey levels, differences and their products.
struct TemplateSums {
  int64_t grey, grey_grey, x, y, x_grey, y_grey, xx, xy, yy;
};
/// `first`: the top left pixel; the patch has a margin of two pixels. False, and nothing done, where vectors
/// are shorter; so below.
bool cutTemplate(const uint8_t* first, size_t stride, const TemplateRows& rows, TemplateSums& sums);

/// (factor * gradient + slope * grey + constant) >> kProjectBits, saturated.
struct GradientProjection {
  int16_t factor, slope_x, slope_y;
  int32_t constant_x, constant_y;
};
/// In place; `sum_x`, `sum_y`: of the products with the grey levels.
bool projectTemplate(const TemplateRows& rows, const GradientProjection& projection, int64_t& sum_x,
                     int64_t& sum_y);

}  // namespace redbee
