#include "redbee/imaging/guided_filter.hpp"

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "redbee/imaging/float_rows.hpp"
#include "redbee/imaging/guided_filter_kernels.hpp"
#include "redbee/imaging/resampled.hpp"

namespace redbee {
namespace {

/// The last rows of a map that is computed from the top.
class RecentRows {
 public:
  RecentRows(size_t width, int kept)
      : width_(width), kept_(kept), values_(width * static_cast<size_t>(kept)) {}
  float* operator[](int y) { return &values_[static_cast<size_t>(y % kept_) * width_]; }

 private:
  size_t width_;
  int kept_;
  std::vector<float> values_;
};

struct MapSize {
  int width, height;
  int side;  ///< px, of the window, which the map holds both ways
};

/// cv::blur() of a map: value(y) is asked for rows in order, as far as half a window beyond the mean's, and
/// again for the last `side` + 1 of them.
class BoxMean {
 public:
  using Value = std::function<const float*(int)>;
  BoxMean(const MapSize& size, Value value)
      : size_(size),
        value_(std::move(value)),
        sums_(static_cast<size_t>(size.width + size.side), 0.0),
        mean_(static_cast<size_t>(size.width)) {}

  /// Rows in order. Valid until the next call.
  const float* operator()(int y) {
    const int radius = size_.side / 2;
    for (; next_ <= y; ++next_) {
      const float* leaving = next_ > 0 ? value_(mirrored(next_ - radius - 1)) : nullptr;
      boxMeanRow({mean_.size(), size_.side, value_(mirrored(next_ + radius)), leaving, sums_.data(),
                  next_ < 0 ? nullptr : mean_.data()});
    }
    return mean_.data();
  }

 private:
  int mirrored(int y) const {
    const int row = std::abs(y);
    return std::min(row, 2 * (size_.height - 1) - row);
  }
  MapSize size_;
  Value value_;
  std::vector<double> sums_;
  std::vector<float> mean_;
  int next_ = -2 * (size_.side / 2);
};

/// Means over the window of slope and offset of the map as a linear function of the guide.
void forEachModelRow(const cv::Mat& guide, const cv::Mat1f& map, int side, double contrast,
                     const std::function<void(int, const float*, const float*)>& visit) {
  const MapSize size{guide.cols, guide.rows, side};
  const auto width = static_cast<size_t>(guide.cols);
  FloatRows guides(guide, side + 1);
  RecentRows squares(width, side + 1), products(width, side + 1);
  int multiplied = 0;
  const auto multiply = [&](int y) {
    for (; multiplied <= y; ++multiplied) {
      const float* const g = guides(multiplied);
      const float* const m = map[multiplied];
      float* const square = squares[multiplied];
      float* const product = products[multiplied];
      for (size_t i = 0; i < width; ++i) square[i] = g[i] * g[i];
      for (size_t i = 0; i < width; ++i) product[i] = g[i] * m[i];
    }
  };
  BoxMean mean_guide(size, [&](int y) { return guides(y); });
  BoxMean mean_map(size, [&](int y) { return map[y]; });
  BoxMean mean_square(size, [&](int y) { return multiply(y), squares[y]; });
  BoxMean mean_product(size, [&](int y) { return multiply(y), products[y]; });
  RecentRows slopes(width, side + 1), offsets(width, side + 1);
  int fitted = 0;
  const auto fit = [&](int y) {
    for (; fitted <= y; ++fitted) {
      linearModelRow({width, mean_guide(fitted), mean_map(fitted), mean_square(fitted), mean_product(fitted),
                      slopes[fitted], offsets[fitted]},
                     static_cast<float>(contrast * contrast));
    }
  };
  BoxMean mean_slope(size, [&](int y) { return fit(y), slopes[y]; });
  BoxMean mean_offset(size, [&](int y) { return fit(y), offsets[y]; });
  for (int y = 0; y < size.height; ++y) visit(y, mean_slope(y), mean_offset(y));
}

cv::Mat asFloat(const cv::Mat& image) {
  if (image.depth() == CV_32F) return image;
  cv::Mat converted;
  image.convertTo(converted, CV_32F);
  return converted;
}

}  // namespace

cv::Mat1f guidedFilter(const cv::Mat& guide, const cv::Mat1f& map, int radius_px, double contrast) {
  // Slope and offset are smooth, so they are computed at a lower resolution.
  const int shrink = std::clamp(radius_px / 2, 1, 4);
  const cv::Size small((guide.cols + shrink - 1) / shrink, (guide.rows + shrink - 1) / shrink);
  const int widest = (std::min(small.width, small.height) - 1) / 2;
  const int side = 2 * std::min(std::max(1, radius_px / shrink), widest) + 1;
  const auto width = static_cast<size_t>(guide.cols);
  FloatRows guides(guide);
  if (shrink == 1) {
    cv::Mat1f filtered(guide.size());
    forEachModelRow(guide, map, side, contrast, [&](int y, const float* slope, const float* offset) {
      applyModelRow(slope, offset, guides(y), width, filtered[y]);
    });
    return filtered;
  }
  cv::Mat1f slopes(small), offsets(small);
  forEachModelRow(resized(asFloat(guide), small, cv::INTER_AREA), resized(map, small, cv::INTER_AREA), side,
                  contrast, [&](int y, const float* slope, const float* offset) {
                    std::copy_n(slope, small.width, slopes[y]);
                    std::copy_n(offset, small.width, offsets[y]);
                  });
  cv::Mat1f filtered = resized(slopes, guide.size());
  const cv::Mat1f offset = resized(offsets, guide.size());
  for (int y = 0; y < guide.rows; ++y) applyModelRow(filtered[y], offset[y], guides(y), width, filtered[y]);
  return filtered;
}

}  // namespace redbee
