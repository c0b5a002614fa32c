#include "redbee/detection/parallax/flow_covariance.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "redbee/imaging/resampled.hpp"

namespace redbee {
namespace {

constexpr double kQuarter = 4;
// Wider than a trunk or a post, the window holds the texture beside it, which says nothing of their flow.
constexpr int kWindow_px = 3;  // of the quarter-size image

}  // namespace

FlowCovariance::FlowCovariance(const cv::Mat3f& map, cv::Size size) : map_(map), size_(size) {
  columns_.reserve(static_cast<size_t>(size.width));
  for (int x = 0; x < size.width; ++x) {
    const Resampled at(x, map.cols, size.width);
    const int left = std::clamp(at.before, 0, map.cols - 1);
    const bool is_between = at.before >= 0 && at.before < map.cols - 1;
    columns_.push_back({left, std::min(left + 1, map.cols - 1), is_between ? at.beyond : 0});
  }
}

FlowCovariance::FlowCovariance(cv::Size size, float variance)
    : FlowCovariance(cv::Mat3f(size, Symmetric2f(variance, 0, variance)), size) {}

Symmetric2f FlowCovariance::along(const Symmetric2f* row, const Column& column) const {
  return row[column.left] * (1 - column.right_weight) + row[column.right] * column.right_weight;
}

Symmetric2f FlowCovariance::operator()(int y, int x) const {
  const Resampled at(y, map_.rows, size_.height);
  const auto inside = [&](int row) { return std::clamp(row, 0, map_.rows - 1); };
  const Column& column = columns_[static_cast<size_t>(x)];
  return along(map_[inside(at.before)], column) * (1 - at.beyond) +
         along(map_[inside(at.before + 1)], column) * at.beyond;
}

FlowCovariance::InterpolatedRow& FlowCovariance::interpolated(int row) {
  InterpolatedRow& kept = kept_[row % 2];
  if (kept.row == row) return kept;
  kept.row = row;
  const size_t width = columns_.size();
  kept.values.resize(3 * width);
  for (size_t x = 0; x < width; ++x) {
    const Symmetric2f value = along(map_[row], columns_[x]);
    for (size_t i = 0; i < 3; ++i) kept.values[i * width + x] = value[static_cast<int>(i)];
  }
  return kept;
}

FlowCovariance::Rows FlowCovariance::rows(int y) {
  const Resampled at(y, map_.rows, size_.height);
  const float* upper = interpolated(std::clamp(at.before, 0, map_.rows - 1)).values.data();
  const float* lower = interpolated(std::clamp(at.before + 1, 0, map_.rows - 1)).values.data();
  const size_t width = columns_.size();
  return {{upper, upper + width, upper + 2 * width},
          {lower, lower + width, lower + 2 * width},
          1 - at.beyond,
          at.beyond};
}

FlowTexture::FlowTexture(const cv::Mat1b& grey, double scale) : size_(grey.size()), scale_(scale) {
  cv::Mat1b quarter;
  cv::resize(grey, quarter, {}, scale / kQuarter, scale / kQuarter, cv::INTER_AREA);
  gradients_ = structureTensor(quarter, kWindow_px);
}

FlowCovariance FlowTexture::covariance(const FlowNoise& noise) const {
  cv::Mat3f covariance(gradients_.size());
  const auto variance = static_cast<float>(std::pow(noise.sigma_px / scale_, 2));
  const auto gradient2 = static_cast<float>(noise.min_gradient * noise.min_gradient);
  const auto covarianceOf = [&](const Symmetric2f& S) {
    return displacementCovariance(S, variance, gradient2);
  };
  std::transform(gradients_.begin(), gradients_.end(), covariance.begin(), covarianceOf);
  return {covariance, size_};
}

}  // namespace redbee
