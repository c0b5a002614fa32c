#include "redbee/imaging/enlarged.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "redbee/imaging/doubling_kernels.hpp"

namespace redbee {

cv::Mat1b enlarged(const cv::Mat1b& map, cv::Size size) {
  cv::Mat1b large;
  if (size != map.size() * 2) {
    cv::resize(map, large, size, 0, 0, cv::INTER_LINEAR);
    return large;
  }
  large.create(size);
  const auto values = static_cast<size_t>(size.width);
  std::vector<uint16_t> memory(3 * values);
  std::array<uint16_t*, 3> rows{memory.data(), memory.data() + values, memory.data() + 2 * values};
  const auto doubled = [&](int y) { return rows[static_cast<size_t>(y) % rows.size()]; };
  const int last = map.rows - 1;
  doubleAcross(map[0], map.cols, doubled(0));
  for (int y = 0; y <= last; ++y) {
    if (y < last) doubleAcross(map[y + 1], map.cols, doubled(y + 1));
    mixRows(doubled(y), doubled(std::max(y - 1, 0)), size.width, large[2 * y]);
    mixRows(doubled(y), doubled(std::min(y + 1, last)), size.width, large[2 * y + 1]);
  }
  return large;
}

}  // namespace redbee
