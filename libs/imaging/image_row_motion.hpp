// Which rows' motion belongs to an image: one that repeats an earlier image was exposed when that was.
#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "redbee/geometry/rolling_shutter.hpp"

namespace redbee {

class ImageRowMotion {
 public:
  /// `raw`: grey, as recorded. `measured`: at its time. For a repeated image (repeated_image.hpp) that of the
  /// image which it repeats, so that both are rectified to the same; std::nullopt only where `measured` is.
  std::optional<RowMotion> of(const cv::Mat1b& raw, const std::optional<RowMotion>& measured);
  void reset() { *this = {}; }

 private:
  cv::Mat1b last_;
  std::optional<RowMotion> last_motion_;
};

}  // namespace redbee
