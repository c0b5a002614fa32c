// Alignment of a patch of one image with another image: the inner loop of the point tracker.
//
// Inverse-compositional Lucas-Kanade (Baker and Matthews, 2004) for a translation: the gradient and its
// matrix belong to the template and are computed once; an iteration samples the other image and computes two
// scalar products. The gradients are made orthogonal to the constant and to the template itself ("project
// out", part 3 of the same), which makes the step invariant to brightness and contrast at no cost.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <vector>

#include "redbee/imaging/pyramid.hpp"
#include "redbee/visual/lanes.hpp"
#include "redbee/visual/patch_kernels.hpp"
#include "redbee/visual/template_kernels.hpp"

namespace redbee {

/// Sides of the square patch.
struct PatchShape {
  explicit PatchShape(int window_px);
  int side;            ///< px, odd
  int half;            ///< px
  int lanes;           ///< groups of eight pixels per row, the last one padded with masked columns
  int gradient_scale;  ///< of the stored gradients; the largest that cannot overflow
  /// Margin that a pyramid needs for patches with a centre up to kOverhang px outside the image.
  int margin() const { return half + kOverhang + 12; }
  static constexpr int kOverhang = 8;
};

struct AlignmentLimits {
  int iterations;
  double epsilon_px;
};

enum class Alignment {
  kLost,          ///< left the image
  kNotConverged,  ///< still moving at the last iteration
  kConverged,     ///< the last step was short
};

/// Lanes: PortableLanes or Sse2Lanes.
template <typename Lanes>
class PatchTemplate {
 public:
  explicit PatchTemplate(const PatchShape& shape)
      : shape_(shape),
        size_(static_cast<std::size_t>(shape.side * shape.lanes * 8)),
        grey_(size_),
        gradient_x_(size_),
        gradient_y_(size_) {
    mask_.assign(static_cast<std::size_t>(shape.lanes * 8), 0);
    for (int x = 0; x < shape.side; ++x) mask_[static_cast<std::size_t>(x)] = -1;
  }

  /// Extracts the template around a pixel, which must lie in the image.
  void extract(const PyramidLevel& level, int x, int y);

  /// smallestEigenvalue() of the patch around a pixel; the template is unchanged.
  double texture(const PyramidLevel& level, int x, int y);

  /// grey levels^2 / px^2, per pixel: the smaller eigenvalue of the mean gradient matrix.
  double smallestEigenvalue() const { return smallest_eigenvalue_; }

  /// Moves `centre` [px of `level`] to the best alignment.
  Alignment align(const PyramidLevel& level, Eigen::Vector2d& centre, const AlignmentLimits& limits) const;

  /// Mean absolute difference [grey levels] to the patch at `centre`, after subtracting the means.
  double residual(const PyramidLevel& level, const Eigen::Vector2d& centre) const;

 private:
  struct Moments;
  TemplateRows stored();
  Moments cut(const PyramidLevel& level, int x, int y);
  void solve(const Moments& m);
  void projectGradients();
  void sample(const SampledPatch& patch, int16_t* samples) const;
  PatchProducts products(const uint8_t* corner, std::size_t stride, const BilinearWeights& weights) const;

  PatchShape shape_;
  std::size_t size_;
  std::vector<int16_t> mask_;
  std::vector<int16_t> grey_, gradient_x_, gradient_y_;
  double smallest_eigenvalue_ = 0;
  double slope_x_ = 0, slope_y_ = 0, constant_x_ = 0, constant_y_ = 0;
  double inverse_xx_ = 0, inverse_xy_ = 0, inverse_yy_ = 0;
  int64_t offset_x_ = 0, offset_y_ = 0;
  double mean_grey_ = 0;
};

extern template class PatchTemplate<PortableLanes>;
#if defined(__SSE2__)
extern template class PatchTemplate<Sse2Lanes>;
#endif

}  // namespace redbee
