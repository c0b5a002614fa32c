#include "redbee/detection/parallax/border_structure.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "redbee/imaging/grey_reconstruction.hpp"

namespace redbee {
namespace {

constexpr double kShrink = 2;  // evidence is smooth, so half the resolution is enough
constexpr int kLeastSide_px = 8;

/// Opening of the line by `stretch` pixels.
cv::Mat1f wideLevels(const cv::Mat1f& line, int stretch) {
  const cv::Mat1b bar = line.rows == 1 ? cv::Mat1b::ones(1, stretch) : cv::Mat1b::ones(stretch, 1);
  cv::Mat1f opened;
  cv::morphologyEx(line, opened, cv::MORPH_OPEN, bar, {-1, -1}, 1, cv::BORDER_REPLICATE);
  return opened;
}

/// The opened levels of the four sides, one pixel inside the border.
cv::Mat1f seeds(const cv::Mat1f& motion, int stretch) {
  cv::Mat1f seeds = cv::Mat1f::zeros(motion.size());
  const cv::Rect lines[] = {{0, 1, motion.cols, 1},
                            {0, motion.rows - 2, motion.cols, 1},
                            {1, 0, 1, motion.rows},
                            {motion.cols - 2, 0, 1, motion.rows}};
  for (const cv::Rect& line : lines) {
    cv::Mat1f here = seeds(line);
    // As cv::Mat: of three equal types, std::max would be called.
    const cv::Mat wide = wideLevels(motion(line), stretch);
    cv::max(here, wide, here);
  }
  return seeds;
}

}  // namespace

cv::Mat1f fractionOfBorderStructure(const cv::Mat1f& motion, const cv::Mat1b& unknown, double stretch_px) {
  cv::Mat1f small;
  cv::Mat1b hidden;
  cv::resize(motion, small, {}, 1 / kShrink, 1 / kShrink, cv::INTER_AREA);
  cv::resize(unknown, hidden, small.size(), 0, 0, cv::INTER_NEAREST);
  const cv::Rect known = cv::boundingRect(hidden == 0);
  if (std::min(known.width, known.height) < kLeastSide_px) return cv::Mat1f::zeros(motion.size());
  const cv::Mat1f limit = small(known);
  const int stretch = std::max(1, static_cast<int>(std::lround(stretch_px / kShrink)));
  cv::Mat1f level = seeds(limit, stretch);
  reconstruct(limit, level);
  cv::Mat1f whole = cv::Mat1f::zeros(small.size());
  level.copyTo(whole(known));
  cv::resize(whole, whole, motion.size(), 0, 0, cv::INTER_LINEAR);
  constexpr double kNone = 1e-3;  // less evidence counts as none, with fraction 0
  return cv::Mat1f(cv::min(whole / (motion + kNone), 1));
}

}  // namespace redbee
