#include "redbee/detection/objects/outline_contrast.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
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
  cv::Point2d along, across;  ///< the longer one first, over the standard deviation
};

Axes axesOf(const cv::Mat1f& depth) {
  int64_t count = 0, sum_x = 0, sum_y = 0, sum_xx = 0, sum_yy = 0, sum_xy = 0;
  for (int v = 0; v < depth.rows; ++v) {
    const float* const row = depth[v];
    int in_row = 0, x_of_row = 0;
    int64_t xx_of_row = 0;
    for (int u = 0; u < depth.cols; ++u) {
      if (row[u] == 0) continue;
      ++in_row;
      x_of_row += u;
      xx_of_row += u * u;
    }
    count += in_row;
    sum_x += x_of_row;
    sum_xx += xx_of_row;
    sum_y += static_cast<int64_t>(v) * in_row;
    sum_yy += static_cast<int64_t>(v) * v * in_row;
    sum_xy += static_cast<int64_t>(v) * x_of_row;
  }
  const auto n = static_cast<double>(count);
  const double x = static_cast<double>(sum_x) / n, y = static_cast<double>(sum_y) / n;
  const double xx = static_cast<double>(sum_xx) / n - x * x + kPixelVariance;
  const double yy = static_cast<double>(sum_yy) / n - y * y + kPixelVariance;
  const double xy = static_cast<double>(sum_xy) / n - x * y;
  const double angle = 0.5 * std::atan2(2 * xy, xx - yy);
  const double c = std::cos(angle), s = std::sin(angle);
  const double sigma_along = std::sqrt(c * c * xx + 2 * c * s * xy + s * s * yy);
  const double across = s * s * xx - 2 * c * s * xy + c * c * yy;
  const double sigma_across = std::sqrt(std::max(across, kLeastAcross_px2));
  return {{x, y}, {c / sigma_along, s / sigma_along}, {-s / sigma_across, c / sigma_across}};
}

/// Of the angle, in eighths of a turn: 4 is along, 6 across, 0 against the first axis.
size_t sectorOf(const Axes& axes, double x, double y) {
  constexpr double kTangent = 0.41421356237309503;  // of half a sector
  const double dx = x - axes.centre.x, dy = y - axes.centre.y;
  const double along = axes.along.x * dx + axes.along.y * dy;
  const double across = axes.across.x * dx + axes.across.y * dy;
  const double a = std::abs(along), b = std::abs(across);
  const size_t from_axis = b < kTangent * a ? 0 : (a < kTangent * b ? 2 : 1);
  if (a == 0 && b == 0) return kSectors / 2;
  if (along >= 0) return across >= 0 ? kSectors / 2 + from_axis : kSectors / 2 - from_axis;
  return across >= 0 ? (kSectors - from_axis) % kSectors : from_axis;
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
    const float* const distances = distance[y];
    const cv::Vec4b* const row = colours[around.y + y] + around.x;
    const bool is_in_box = in_box_y >= 0 && in_box_y < box.height;
    const float* const depths = is_in_box ? depth[in_box_y] + (around.x - box.x) : nullptr;
    for (int x = 0; x < around.width; ++x) {
      const float d = distances[x];
      const bool is_inside = d == 0 && depths != nullptr && depths[x] <= kInside_px;
      if (!is_inside && (d <= ring.begins || d > ring.ends)) continue;
      const size_t sector = sectorOf(axes, around.x + x - box.x, in_box_y);
      (is_inside ? inside : outside)[sector].add(row[x]);
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
