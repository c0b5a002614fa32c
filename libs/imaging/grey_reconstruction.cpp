#include "redbee/imaging/grey_reconstruction.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "redbee/imaging/connected_regions.hpp"

namespace redbee {
namespace {

constexpr int kSweeps = 3;  // forth and back
constexpr double kOutline = 0.02;

/// One sweep: propagates `level` along each row and from the row before, bounded by `limit`.
void sweep(const cv::Mat1f& limit, cv::Mat1f& level, bool forth) {
  const int step = forth ? 1 : -1;
  const int first_x = forth ? 1 : level.cols - 2, end_x = forth ? level.cols : -1;
  const int first_y = forth ? 1 : level.rows - 2, end_y = forth ? level.rows : -1;
  for (int y = first_y; y != end_y; y += step) {
    const float* top = limit[y];
    const float* before = level[y - step];
    float* now = level[y];
    for (int x = first_x; x != end_x; x += step) {
      now[x] = std::min(top[x], std::max({now[x], before[x], now[x - step]}));
    }
  }
}

void copyBorder(const cv::Mat1f& from, cv::Mat1f& to) {
  from.row(0).copyTo(to.row(0));
  from.row(from.rows - 1).copyTo(to.row(to.rows - 1));
  from.col(0).copyTo(to.col(0));
  from.col(from.cols - 1).copyTo(to.col(to.cols - 1));
}

}  // namespace

void reconstruct(const cv::Mat1f& limit, cv::Mat1f& level) {
  for (int i = 0; i < kSweeps; ++i) {
    for (const bool forth : {true, false}) sweep(limit, level, forth);
  }
}

void fillHoles(cv::Mat1f& map, int gap_px) {
  const int side = (gap_px + 1) | 1;
  cv::Mat1f open;
  cv::morphologyEx(map, open, cv::MORPH_CLOSE, cv::getStructuringElement(cv::MORPH_RECT, {side, side}));
  // An outline lies within one component: each is a small image of its own.
  const ConnectedRegions components(open > kOutline);
  cv::subtract(1, open, open);
  std::vector<float> outside;
  for (size_t i = 0; i < components.size(); ++i) {
    const cv::Rect inside = components.box(i);
    if (std::min(inside.width, inside.height) < 3) continue;
    outside.assign(static_cast<size_t>(inside.area()), 0);
    cv::Mat1f level(inside.height, inside.width, outside.data());
    copyBorder(open(inside), level);
    reconstruct(open(inside), level);
    for (int y = 0; y < level.rows; ++y) {
      float* here = map[inside.y + y] + inside.x;
      const float* reached = level[y];
      for (int x = 0; x < level.cols; ++x) here[x] = std::max(here[x], 1 - reached[x]);
    }
  }
}

}  // namespace redbee
