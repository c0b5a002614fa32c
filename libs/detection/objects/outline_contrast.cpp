#include "redbee/detection/objects/outline_contrast.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace redbee {
namespace {

constexpr size_t kSectors = 8;
constexpr float kInside_px = 2.5F;      // of the maps: how far the outline's inside reaches
constexpr double kPixelVariance = 0.3;  // of a pixel's own extent, so that a line has a width
constexpr double kLeastAcross_px2 = 0.1;

/// Centre and principal axes of the region's pixels, in its box.
struct Axes {
  cv::Point2d centre;
  cv::Point2d along;  ///< unit vector of the longer one
  double sigma_along, sigma_across;
};

Axes axesOf(const cv::Mat1f& depth) {
  double n = 0, x = 0, y = 0, xx = 0, yy = 0, xy = 0;
  for (int v = 0; v < depth.rows; ++v) {
    const float* const row = depth[v];
    for (int u = 0; u < depth.cols; ++u) {
      if (row[u] == 0) continue;
      n += 1;
      x += u;
      y += v;
      xx += u * u;
      yy += v * v;
      xy += u * v;
    }
  }
  x /= n;
  y /= n;
  xx = xx / n - x * x + kPixelVariance;
  yy = yy / n - y * y + kPixelVariance;
  xy = xy / n - x * y;
  const double angle = 0.5 * std::atan2(2 * xy, xx - yy);
  const double c = std::cos(angle), s = std::sin(angle);
  const double along = c * c * xx + 2 * c * s * xy + s * s * yy;
  const double across = s * s * xx - 2 * c * s * xy + c * c * yy;
  return {{x, y}, {c, s}, std::sqrt(along), std::sqrt(std::max(across, kLeastAcross_px2))};
}

size_t sectorOf(const Axes& axes, double x, double y) {
  const double dx = x - axes.centre.x, dy = y - axes.centre.y;
  const double along = (axes.along.x * dx + axes.along.y * dy) / axes.sigma_along;
  const double across = (axes.along.x * dy - axes.along.y * dx) / axes.sigma_across;
  const double turns = std::atan2(across, along) / (2 * CV_PI) + 0.5;
  return static_cast<size_t>(std::floor(turns * kSectors + 0.5)) % kSectors;
}

struct ColourSum {
  std::array<int, 3> sum{};
  int count = 0;

  void add(const cv::Vec4b& colour) {
    for (size_t i = 0; i < sum.size(); ++i) sum[i] += colour[static_cast<int>(i)];
    ++count;
  }
  double mean(size_t channel) const { return static_cast<double>(sum[channel]) / count; }
};

/// Not a number if one of them is empty.
float contrastOf(const ColourSum& a, const ColourSum& b) {
  if (a.count == 0 || b.count == 0) return std::numeric_limits<float>::quiet_NaN();
  double most = 0;
  for (size_t i = 0; i < a.sum.size(); ++i) most = std::max(most, std::abs(a.mean(i) - b.mean(i)));
  return static_cast<float>(most);
}

}  // namespace

OutlineContrast outlineContrast(const cv::Mat4b& colours, const cv::Rect& box, const cv::Mat1f& depth,
                                const cv::Rect& around, const cv::Mat1f& distance, const OutlineRing& ring) {
  const Axes axes = axesOf(depth);
  std::array<ColourSum, kSectors> inside{}, outside{};
  for (int y = 0; y < around.height; ++y) {
    const int in_box_y = around.y + y - box.y;
    for (int x = 0; x < around.width; ++x) {
      const float d = distance(y, x);
      const int in_box_x = around.x + x - box.x;
      const bool is_inside = d == 0 && depth(in_box_y, in_box_x) <= kInside_px;
      if (!is_inside && (d <= ring.begins || d > ring.ends)) continue;
      const size_t sector = sectorOf(axes, in_box_x, in_box_y);
      (is_inside ? inside : outside)[sector].add(colours(around.y + y, around.x + x));
    }
  }
  std::array<float, kSectors> known{};
  size_t count = 0;
  for (size_t i = 0; i < kSectors; ++i) {
    const float of_sector = contrastOf(inside[i], outside[i]);
    if (!std::isnan(of_sector)) known[count++] = of_sector;
  }
  constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
  OutlineContrast contrast{kUnknown, kUnknown, kUnknown, kUnknown};
  if (count > 0) {
    float sum = 0;
    for (size_t i = 0; i < count; ++i) sum += known[i];
    std::fill(known.begin() + static_cast<std::ptrdiff_t>(count), known.end(),
              std::numeric_limits<float>::infinity());
    std::sort(known.begin(), known.end());
    contrast.least = known[0];
    contrast.second = known[count > 1 ? 1 : 0];
    contrast.median = known[count / 2];
    contrast.mean = sum / static_cast<float>(count);
  }
  return contrast;
}

}  // namespace redbee
