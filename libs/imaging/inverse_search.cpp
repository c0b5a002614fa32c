#include "redbee/imaging/inverse_search.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "redbee/imaging/resampled.hpp"

namespace redbee {
namespace {

constexpr int kWeightRows = 16;

PatchGradients operator+(const PatchGradients& a, const PatchGradients& b) {
  return {a.xx + b.xx, a.xy + b.xy, a.yy + b.yy, a.x + b.x, a.y + b.y};
}
PatchGradients operator-(const PatchGradients& a, const PatchGradients& b) {
  return {a.xx - b.xx, a.xy - b.xy, a.yy - b.yy, a.x - b.x, a.y - b.y};
}

/// The flow of a pixel of the next finer scale, as cv::resize() interpolates it.
cv::Vec2f finerFlow(const cv::Mat2f& flow, const Resampled& column, const Resampled& row) {
  const auto along = [&](int y) -> cv::Vec2f {
    const cv::Vec2f* of = flow[std::clamp(y, 0, flow.rows - 1)];
    if (column.before < 0) return of[0];
    if (column.before >= flow.cols - 1) return of[flow.cols - 1];
    return of[column.before] * (1 - column.beyond) + of[column.before + 1] * column.beyond;
  };
  return 2 * (along(row.before) * (1 - row.beyond) + along(row.before + 1) * row.beyond);
}

}  // namespace

int InverseSearch::coarsestScale(cv::Size image) const {
  const auto refuse = [] { throw std::invalid_argument("inverse search: the image is too small"); };
  const int patches = std::min(image.width, image.height) / kSearchPatch_px;
  if (patches < 1) refuse();
  const double halvings =
      std::log(std::max(image.width, image.height) / (4.0 * kSearchPatch_px)) / std::log(2.0) + 0.5;
  const double with_patch = std::log(static_cast<double>(patches)) / std::log(2.0);
  const int coarsest = std::min(static_cast<int>(halvings), static_cast<int>(with_patch));
  if (coarsest < parameters_.finest_scale) refuse();
  return coarsest;
}

void InverseSearch::prepare(const cv::Mat1b& from, const cv::Mat1b& to) {
  scales_.resize(static_cast<size_t>(coarsestScale(from.size()) - parameters_.finest_scale + 1));
  for (size_t i = 0; i < scales_.size(); ++i) {
    Scale& scale = scales_[i];
    const cv::Mat1b& finer_from = i == 0 ? from : scales_[i - 1].from;
    const cv::Mat1b& finer_to = i == 0 ? to : scales_[i - 1].to;
    const int shrink = i == 0 ? 1 << parameters_.finest_scale : 2;
    const cv::Size size = finer_from.size() / shrink;
    cv::resize(finer_from, scale.from, size, 0, 0, cv::INTER_AREA);
    cv::resize(finer_to, scale.to, size, 0, 0, cv::INTER_AREA);
    constexpr int kMargin = kSearchMargin_px;
    cv::copyMakeBorder(scale.to, scale.to_padded, kMargin, kMargin, kMargin, kMargin, cv::BORDER_REPLICATE);
    scale.flow.create(size);
  }
}

SearchLevel InverseSearch::levelOf(const Scale& scale) {
  cv::spatialGradient(scale.from, gradient_x_, gradient_y_);
  SearchLevel level{};
  level.width = scale.from.cols;
  level.height = scale.from.rows;
  level.stride_px = parameters_.stride_px;
  level.columns = 1 + (level.width - kSearchPatch_px) / level.stride_px;
  level.rows = 1 + (level.height - kSearchPatch_px) / level.stride_px;
  level.iterations = parameters_.iterations / 2;
  level.from = scale.from[0];
  level.from_x = gradient_x_[0];
  level.from_y = gradient_y_[0];
  level.to = scale.to_padded[0];
  return level;
}

/// Running sums over rows: what is beyond the precision of a float stays in them, as it does in OpenCV's.
void InverseSearch::sumOverPatches(const SearchLevel& level) {
  const auto columns = static_cast<size_t>(level.columns);
  constexpr int kKept = kSearchPatch_px + 1;
  row_sums_.resize(columns * kKept);
  gradients_.resize(columns * static_cast<size_t>(level.rows));
  running_.assign(columns, {0, 0, 0, 0, 0});
  for (int y = 0; y < level.height; ++y) {
    const auto sumsOf = [&](int row) { return &row_sums_[columns * static_cast<size_t>(row % kKept)]; };
    PatchGradients* sums = sumsOf(y);
    sumGradients(level, y, sums);
    const int begin = y - kSearchPatch_px + 1;
    const PatchGradients* left = begin > 0 ? sumsOf(y - kSearchPatch_px) : nullptr;
    for (size_t i = 0; i < columns; ++i) running_[i] = running_[i] + (left ? sums[i] - left[i] : sums[i]);
    if (begin < 0 || begin % level.stride_px != 0) continue;
    std::copy(running_.begin(), running_.end(),
              &gradients_[columns * static_cast<size_t>(begin / level.stride_px)]);
  }
}

void InverseSearch::startFrom(const cv::Mat2f& coarser, const SearchLevel& level) {
  constexpr int kHalf = kSearchPatch_px / 2;
  const auto patches = static_cast<size_t>(level.columns) * static_cast<size_t>(level.rows);
  u_.assign(patches, 0);
  v_.assign(patches, 0);
  if (coarser.empty()) return;
  for (int row = 0; row < level.rows; ++row) {
    const Resampled y(row * level.stride_px + kHalf, coarser.rows, level.height);
    for (int column = 0; column < level.columns; ++column) {
      const Resampled x(column * level.stride_px + kHalf, coarser.cols, level.width);
      const cv::Vec2f flow = finerFlow(coarser, x, y);
      u_[level.patch(column, row)] = flow[0];
      v_[level.patch(column, row)] = flow[1];
    }
  }
}

const cv::Mat2f& InverseSearch::flow(const cv::Mat1b& from, const cv::Mat1b& to) {
  if (from.size() != to.size()) throw std::invalid_argument("inverse search: images of different sizes");
  prepare(from, to);
  for (size_t i = scales_.size(); i-- > 0;) {
    const SearchLevel level = levelOf(scales_[i]);
    sumOverPatches(level);
    startFrom(i + 1 < scales_.size() ? scales_[i + 1].flow : cv::Mat2f(), level);
    searchPatches(level, gradients_.data(), u_.data(), v_.data());
    weights_.resize(static_cast<size_t>(level.width) * kWeightRows);
    densify(level, u_.data(), v_.data(), weights_.data(), scales_[i].flow.ptr<float>());
  }
  if (parameters_.finest_scale == 0) return scales_[0].flow;
  cv::resize(scales_[0].flow, full_, from.size());
  full_ *= 1 << parameters_.finest_scale;
  return full_;
}

}  // namespace redbee
