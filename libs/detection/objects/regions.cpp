#include "redbee/detection/objects/regions.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

#include "redbee/detection/foreground_maps.hpp"

namespace redbee {
namespace {

constexpr int kTile_px = 16;

bool isAnySet(const uint8_t* from, int count) {
  if (count < kTile_px) return std::any_of(from, from + count, [](uint8_t value) { return value != 0; });
  std::array<uint64_t, kTile_px / sizeof(uint64_t)> words{};
  std::memcpy(words.data(), from, kTile_px);
  return (words[0] | words[1]) != 0;
}

/// 255 for each tile of a mask in which something is set, and for those around it as far as `reach_px`.
cv::Mat1b tilesAround(const cv::Mat1b& mask, int reach_px) {
  const auto tiles = [](int pixels) { return (pixels + kTile_px - 1) / kTile_px; };
  cv::Mat1b set = cv::Mat1b::zeros(tiles(mask.rows), tiles(mask.cols));
  for (int y = 0; y < mask.rows; ++y) {
    uint8_t* row = set[y / kTile_px];
    const uint8_t* pixels = mask[y];
    for (int x = 0; x < mask.cols; x += kTile_px, ++row) {
      if (isAnySet(pixels + x, std::min(kTile_px, mask.cols - x))) *row = 255;
    }
  }
  const int around = 2 * tiles(reach_px) + 1;
  cv::dilate(set, set, cv::Mat1b::ones(around, around));
  return set;
}

}  // namespace

cv::Mat1b closed(const cv::Mat1b& mask, int diameter) {
  const int reach = diameter / 2 + 1;
  const cv::Rect whole({}, mask.size());
  cv::Mat1b result = cv::Mat1b::zeros(mask.size());
  const ConnectedRegions regions(tilesAround(mask, reach));
  for (size_t i = 0; i < regions.size(); ++i) {
    const cv::Rect tiles = regions.box(i);
    const cv::Rect box = cv::Rect(tiles.tl() * kTile_px, tiles.size() * kTile_px) & whole;
    // A pixel of the dilated mask, and by it one of the eroded, depends on what is as far away again.
    const cv::Rect grown =
        cv::Rect(box.x - 2 * reach, box.y - 2 * reach, box.width + 4 * reach, box.height + 4 * reach) & whole;
    cv::Mat1b part;
    cv::morphologyEx(mask(grown), part, cv::MORPH_CLOSE, disc(diameter));
    part(box - grown.tl()).copyTo(result(box));
  }
  return result;
}

double meanAround(const cv::Mat1f& map, cv::Size image, const cv::Rect& box) {
  constexpr double kPatch_px = 8;  // half a patch of the flow
  constexpr double kLeastReach_px = 16;
  const double scale = static_cast<double>(map.cols) / image.width;
  const auto grown = [&](double by) {
    const cv::Point low(cvRound(scale * (box.x - by)), cvRound(scale * (box.y - by)));
    const cv::Point high(cvRound(scale * (box.br().x + by)), cvRound(scale * (box.br().y + by)));
    return cv::Rect(low, high) & cv::Rect({}, map.size());
  };
  const cv::Rect inner = grown(kPatch_px);
  const cv::Rect outer = grown(kPatch_px + std::max<double>(kLeastReach_px, std::max(box.width, box.height)));
  double sum = 0;
  int count = 0;
  for (int y = outer.y; y < outer.br().y; ++y) {
    for (int x = outer.x; x < outer.br().x; ++x) {
      if (inner.contains({x, y}) || map(y, x) == kNotCompared) continue;
      sum += map(y, x);
      ++count;
    }
  }
  return count > 0 ? sum / count : 1;
}

}  // namespace redbee
