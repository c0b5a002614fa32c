// Memory of maps that are written in every frame from those of the frame before: one map of each size,
// which is exchanged for the one that was read.
#pragma once

#include <algorithm>
#include <opencv2/core.hpp>
#include <vector>

namespace redbee {

class SpareMaps {
 public:
  /// Of unknown content. The reference is valid until the next call.
  cv::Mat4f& ofSize(cv::Size size) {
    const auto found =
        std::find_if(maps_.begin(), maps_.end(), [&](const cv::Mat4f& map) { return map.size() == size; });
    return found != maps_.end() ? *found : maps_.emplace_back(size);
  }
  void clear() { maps_.clear(); }

 private:
  std::vector<cv::Mat4f> maps_;
};

}  // namespace redbee
