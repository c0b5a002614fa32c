#include "redbee/visual/patch_alignment.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "redbee/visual/sample_place.hpp"

namespace redbee {
namespace {

constexpr int kMaxWindow = 31;

}  // namespace

PatchShape::PatchShape(int window_px) : side(window_px), half(window_px / 2), lanes((window_px + 7) / 8) {
  if (window_px < 3 || window_px > kMaxWindow || window_px % 2 == 0) {
    throw std::invalid_argument("the tracker's window must be odd and 3 to 31 px wide");
  }
  // A 32-bit sum adds two products of a sample and a gradient per group of eight.
  constexpr double kLargestSample = 255 << kSampleBits;
  constexpr double kLargestGradient = 255;
  const double largest_sum = 2.0 * lanes * side * kLargestSample * kLargestGradient;
  gradient_scale = std::min(16, static_cast<int>(2147483647.0 / largest_sum));
}

template <typename Lanes>
struct PatchTemplate<Lanes>::Moments {
  /// The stored differences span two pixels: half of them is the gradient.
  explicit Moments(const TemplateSums& sums)
      : grey(static_cast<double>(sums.grey)),
        grey_grey(static_cast<double>(sums.grey_grey)),
        x(static_cast<double>(sums.x) / 2),
        y(static_cast<double>(sums.y) / 2),
        x_grey(static_cast<double>(sums.x_grey) / 2),
        y_grey(static_cast<double>(sums.y_grey) / 2),
        xx(static_cast<double>(sums.xx) / 4),
        xy(static_cast<double>(sums.xy) / 4),
        yy(static_cast<double>(sums.yy) / 4) {}
  double grey, grey_grey, x, y, x_grey, y_grey, xx, xy, yy;
};

template <typename Lanes>
TemplateRows PatchTemplate<Lanes>::stored() {
  return {shape_.side, shape_.lanes, mask_.data(), grey_.data(), gradient_x_.data(), gradient_y_.data()};
}

template <typename Lanes>
void PatchTemplate<Lanes>::extract(const PyramidLevel& level, int x, int y) {
  solve(cut(level, x, y));
  if (smallest_eigenvalue_ > 0) projectGradients();
}

template <typename Lanes>
double PatchTemplate<Lanes>::texture(const PyramidLevel& level, int x, int y) {
  solve(cut(level, x, y));
  return smallest_eigenvalue_;
}

template <typename Lanes>
typename PatchTemplate<Lanes>::Moments PatchTemplate<Lanes>::cut(const PyramidLevel& level, int x, int y) {
  const std::size_t stride = level.stride();
  const uint8_t* row = level.at(x - shape_.half, y - shape_.half);
  TemplateSums sums{};
  if (Lanes::kMayBeLonger && cutTemplate(row, stride, stored(), sums)) return Moments(sums);
  const auto one = Lanes::spread(1);
  auto grey = Lanes::zero(), grey_grey = Lanes::zero(), sum_x = Lanes::zero(), sum_y = Lanes::zero();
  auto x_grey = Lanes::zero(), y_grey = Lanes::zero();
  auto xx = Lanes::zero(), xy = Lanes::zero(), yy = Lanes::zero();
  std::size_t at = 0;
  for (int i = 0; i < shape_.side; ++i, row += stride) {
    for (int lane = 0; lane < shape_.lanes; ++lane, at += 8) {
      const uint8_t* p = row + 8 * lane;
      const auto mask = Lanes::load(&mask_[static_cast<std::size_t>(8 * lane)]);
      const auto t = Lanes::mask(Lanes::loadBytes(p), mask);
      const auto gx = Lanes::mask(Lanes::subtract(Lanes::loadBytes(p + 1), Lanes::loadBytes(p - 1)), mask);
      const auto gy =
          Lanes::mask(Lanes::subtract(Lanes::loadBytes(p + stride), Lanes::loadBytes(p - stride)), mask);
      Lanes::store(&grey_[at], t);
      Lanes::store(&gradient_x_[at], gx);
      Lanes::store(&gradient_y_[at], gy);
      grey = Lanes::addProducts(grey, t, one);
      grey_grey = Lanes::addProducts(grey_grey, t, t);
      sum_x = Lanes::addProducts(sum_x, gx, one);
      sum_y = Lanes::addProducts(sum_y, gy, one);
      x_grey = Lanes::addProducts(x_grey, gx, t);
      y_grey = Lanes::addProducts(y_grey, gy, t);
      xx = Lanes::addProducts(xx, gx, gx);
      xy = Lanes::addProducts(xy, gx, gy);
      yy = Lanes::addProducts(yy, gy, gy);
    }
  }
  return Moments({Lanes::total(grey), Lanes::total(grey_grey), Lanes::total(sum_x), Lanes::total(sum_y),
                  Lanes::total(x_grey), Lanes::total(y_grey), Lanes::total(xx), Lanes::total(xy),
                  Lanes::total(yy)});
}

template <typename Lanes>
void PatchTemplate<Lanes>::solve(const Moments& m) {
  const double n = shape_.side * shape_.side;
  const double variance = m.grey_grey - m.grey * m.grey / n;
  mean_grey_ = m.grey / n;
  const auto slope = [&](double g, double g_grey) {
    return variance > n ? (g_grey - g * m.grey / n) / variance : 0.0;
  };
  slope_x_ = slope(m.x, m.x_grey);
  slope_y_ = slope(m.y, m.y_grey);
  constant_x_ = (m.x - slope_x_ * m.grey) / n;
  constant_y_ = (m.y - slope_y_ * m.grey) / n;
  const double xx = m.xx - constant_x_ * m.x - slope_x_ * m.x_grey;
  const double xy = m.xy - constant_x_ * m.y - slope_x_ * m.y_grey;
  const double yy = m.yy - constant_y_ * m.y - slope_y_ * m.y_grey;
  const double determinant = xx * yy - xy * xy;
  smallest_eigenvalue_ = (0.5 * (xx + yy) - std::sqrt(0.25 * (xx - yy) * (xx - yy) + xy * xy)) / n;
  if (!(smallest_eigenvalue_ > 0) || !(determinant > 0)) {
    smallest_eigenvalue_ = 0;
    return;
  }
  inverse_xx_ = yy / determinant;
  inverse_xy_ = -xy / determinant;
  inverse_yy_ = xx / determinant;
}

template <typename Lanes>
void PatchTemplate<Lanes>::projectGradients() {
  const int unit = shape_.gradient_scale << kProjectBits;
  const auto factor = static_cast<int16_t>(unit / 2);
  const auto fixedSlope = [&](double s) {
    return static_cast<int16_t>(-rounded(std::clamp(s, -1.0, 1.0) * unit));
  };
  const auto fixedConstant = [&](double c) { return -rounded(c * unit) + (1 << (kProjectBits - 1)); };
  const int16_t fixed_slope_x = fixedSlope(slope_x_), fixed_slope_y = fixedSlope(slope_y_);
  const int32_t fixed_constant_x = fixedConstant(constant_x_), fixed_constant_y = fixedConstant(constant_y_);
  const GradientProjection projection{factor, fixed_slope_x, fixed_slope_y, fixed_constant_x,
                                      fixed_constant_y};
  if (Lanes::kMayBeLonger && projectTemplate(stored(), projection, offset_x_, offset_y_)) {
    offset_x_ *= 1 << kSampleBits;
    offset_y_ *= 1 << kSampleBits;
    return;
  }
  auto sum_x = Lanes::zero(), sum_y = Lanes::zero();
  std::size_t at = 0;
  for (int i = 0; i < shape_.side; ++i) {
    for (int lane = 0; lane < shape_.lanes; ++lane, at += 8) {
      const auto mask = Lanes::load(&mask_[static_cast<std::size_t>(8 * lane)]);
      const auto t = Lanes::load(&grey_[at]);
      const auto gx = Lanes::mask(
          Lanes::project(Lanes::load(&gradient_x_[at]), factor, t, fixed_slope_x, fixed_constant_x), mask);
      const auto gy = Lanes::mask(
          Lanes::project(Lanes::load(&gradient_y_[at]), factor, t, fixed_slope_y, fixed_constant_y), mask);
      Lanes::store(&gradient_x_[at], gx);
      Lanes::store(&gradient_y_[at], gy);
      sum_x = Lanes::addProducts(sum_x, t, gx);
      sum_y = Lanes::addProducts(sum_y, t, gy);
    }
  }
  offset_x_ = Lanes::total(sum_x) * (1 << kSampleBits);
  offset_y_ = Lanes::total(sum_y) * (1 << kSampleBits);
}

/// Of the samples at a place with either gradient.
template <typename Lanes>
PatchProducts PatchTemplate<Lanes>::products(const uint8_t* corner, std::size_t stride,
                                             const BilinearWeights& weights) const {
  PatchProducts sums{};
  if (Lanes::kMayBeLonger && sampleProducts({corner, stride, shape_.side, shape_.lanes, weights},
                                            gradient_x_.data(), gradient_y_.data(), sums))
    return sums;
  auto sum_x = Lanes::zero(), sum_y = Lanes::zero();
  std::size_t at = 0;
  for (int i = 0; i < shape_.side; ++i, corner += stride) {
    for (int lane = 0; lane < shape_.lanes; ++lane, at += 8) {
      const auto sample = Lanes::sample(corner + 8 * lane, corner + stride + 8 * lane, weights);
      sum_x = Lanes::addProducts(sum_x, sample, Lanes::load(&gradient_x_[at]));
      sum_y = Lanes::addProducts(sum_y, sample, Lanes::load(&gradient_y_[at]));
    }
  }
  return {Lanes::total(sum_x), Lanes::total(sum_y)};
}

template <typename Lanes>
Alignment PatchTemplate<Lanes>::align(const PyramidLevel& level, Eigen::Vector2d& centre,
                                      const AlignmentLimits& limits) const {
  if (smallest_eigenvalue_ <= 0) return Alignment::kLost;
  const std::size_t stride = level.stride();
  const double unit = 1.0 / (shape_.gradient_scale << kSampleBits);
  for (int iteration = 0; iteration < limits.iterations; ++iteration) {
    if (!isNear(level, centre)) return Alignment::kLost;
    const SamplePlace place(level, centre, shape_.half);
    const PatchProducts sums = products(place.corner, stride, place.weights);
    const double bx = unit * static_cast<double>(sums.x - offset_x_);
    const double by = unit * static_cast<double>(sums.y - offset_y_);
    const Eigen::Vector2d step(inverse_xx_ * bx + inverse_xy_ * by, inverse_xy_ * bx + inverse_yy_ * by);
    centre -= step;
    if (step.squaredNorm() < limits.epsilon_px * limits.epsilon_px) {
      return isNear(level, centre) ? Alignment::kConverged : Alignment::kLost;
    }
  }
  return isNear(level, centre) ? Alignment::kNotConverged : Alignment::kLost;
}

template <typename Lanes>
void PatchTemplate<Lanes>::sample(const SampledPatch& patch, int16_t* samples) const {
  if (Lanes::kMayBeLonger && storeSamples(patch, samples)) return;
  const uint8_t* row = patch.corner;
  for (int i = 0; i < shape_.side; ++i, row += patch.stride) {
    for (int lane = 0; lane < shape_.lanes; ++lane, samples += 8)
      Lanes::store(samples, Lanes::sample(row + 8 * lane, row + patch.stride + 8 * lane, patch.weights));
  }
}

template <typename Lanes>
double PatchTemplate<Lanes>::residual(const PyramidLevel& level, const Eigen::Vector2d& centre) const {
  const SamplePlace place(level, centre, shape_.half);
  const auto one = Lanes::spread(1);
  const auto scale = Lanes::spread(1 << kSampleBits);
  const int pixels = shape_.side * shape_.side;
  std::array<int16_t, kMaxWindow * 8 * ((kMaxWindow + 7) / 8)> samples;
  sample({place.corner, level.stride(), shape_.side, shape_.lanes, place.weights}, samples.data());
  const auto visit = [&](const auto& use) {
    std::size_t at = 0;
    for (int i = 0; i < shape_.side; ++i) {
      for (int lane = 0; lane < shape_.lanes; ++lane, at += 8)
        use(Lanes::load(&samples[at]), at, Lanes::load(&mask_[static_cast<std::size_t>(8 * lane)]));
    }
  };
  auto sum = Lanes::zero();
  visit([&](const auto& value, std::size_t, const auto& mask) {
    sum = Lanes::addProducts(sum, Lanes::mask(value, mask), one);
  });
  const double mean = static_cast<double>(Lanes::total(sum)) / pixels;
  const auto brightness =
      Lanes::spread(static_cast<int16_t>(rounded(mean - mean_grey_ * (1 << kSampleBits))));
  auto absolute = Lanes::zero();
  visit([&](const auto& value, std::size_t at, const auto& mask) {
    const auto expected = Lanes::multiply(Lanes::load(&grey_[at]), scale);
    const auto difference = Lanes::subtract(Lanes::subtract(value, expected), brightness);
    absolute = Lanes::addProducts(absolute, Lanes::mask(Lanes::magnitude(difference), mask), one);
  });
  return static_cast<double>(Lanes::total(absolute)) / (pixels << kSampleBits);
}

template class PatchTemplate<PortableLanes>;
#if defined(__SSE2__)
template class PatchTemplate<Sse2Lanes>;
#endif

}  // namespace redbee
