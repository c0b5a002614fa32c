#include "redbee/detection/parallax/flow_covariance.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "redbee/detection/parallax/flow_covariance_kernels.hpp"
#include "redbee/imaging/resampled.hpp"

namespace redbee {
namespace {

constexpr double kQuarter = 4;
// Wider than a trunk or a post, the window holds the texture beside it, which says nothing of their flow.
constexpr int kWindow_px = 3;  // of the quarter-size image
constexpr int kEntries = 3;    // xx, xy, yy

}  // namespace

FlowCovariance::FlowCovariance(const cv::Mat3f& map, cv::Size size) : map_(map), size_(size) {
  for (int x = 0; x < size.width; ++x) {
    const Resampled at(x, map.cols, size.width);
    const int left = std::clamp(at.before, 0, map.cols - 1);
    const bool is_between = at.before >= 0 && at.before < map.cols - 1;
    left_.push_back(kEntries * left);
    right_.push_back(kEntries * std::min(left + 1, map.cols - 1));
    right_weight_.push_back(is_between ? static_cast<float>(at.beyond) : 0);
  }
}

FlowCovariance::FlowCovariance(cv::Size size, float variance)
    : FlowCovariance(cv::Mat3f(size, Symmetric2f(variance, 0, variance)), size) {}

Symmetric2f FlowCovariance::along(int row, size_t column) const {
  const auto* values = map_.ptr<float>(row);
  const auto entry = [&](int offset) {
    return Symmetric2f(values[offset], values[offset + 1], values[offset + 2]);
  };
  const float beyond = right_weight_[column];
  return entry(left_[column]) * (1 - beyond) + entry(right_[column]) * beyond;
}

Symmetric2f FlowCovariance::operator()(int y, int x) const {
  const Resampled at(y, map_.rows, size_.height);
  const auto inside = [&](int row) { return std::clamp(row, 0, map_.rows - 1); };
  const auto column = static_cast<size_t>(x);
  return along(inside(at.before), column) * (1 - at.beyond) +
         along(inside(at.before + 1), column) * at.beyond;
}

FlowCovariance::InterpolatedRow& FlowCovariance::interpolated(int row) {
  InterpolatedRow& kept = kept_[row % 2];
  if (kept.row == row) return kept;
  kept.row = row;
  const size_t width = right_weight_.size();
  kept.values.resize(kEntries * width);
  interpolateTensors(map_.ptr<float>(row), {left_.data(), right_.data(), right_weight_.data(), width},
                     kept.values.data());
  return kept;
}

FlowCovariance::Rows FlowCovariance::rows(int y) {
  const Resampled at(y, map_.rows, size_.height);
  const float* upper = interpolated(std::clamp(at.before, 0, map_.rows - 1)).values.data();
  const float* lower = interpolated(std::clamp(at.before + 1, 0, map_.rows - 1)).values.data();
  const size_t width = right_weight_.size();
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
  displacementCovariances(gradients_, variance, gradient2, covariance);
  return {covariance, size_};
}

}  // namespace redbee
