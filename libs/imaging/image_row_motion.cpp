#include "redbee/imaging/image_row_motion.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "redbee/imaging/repeated_image.hpp"

namespace redbee {

std::optional<RowMotion> ImageRowMotion::of(const cv::Mat1b& raw, const std::optional<RowMotion>& measured) {
  if (!measured) return std::nullopt;
  constexpr int kDownscale = 2;  // as the images are compared in which a repetition is looked for
  cv::Mat1b small;
  cv::resize(raw, small, {std::max(1, raw.cols / kDownscale), std::max(1, raw.rows / kDownscale)}, 0, 0,
             cv::INTER_AREA);
  const bool is_repeated = last_motion_ && repeats(small, last_, kDownscale);
  last_ = small;
  if (!is_repeated) last_motion_ = measured;
  return last_motion_;
}

}  // namespace redbee
