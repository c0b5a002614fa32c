#include "redbee/detection/objects/regions.hpp"

#include <algorithm>

#include "redbee/detection/foreground_maps.hpp"

namespace redbee {

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
