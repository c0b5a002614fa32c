#include "redbee/detection/parallax/border_structure.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "redbee/imaging/grey_reconstruction.hpp"

namespace redbee {
namespace {

constexpr double kShrink = 2;  // evidence is smooth: half its size will do
constexpr int kLeastSide_px = 8;

/// Levels that the line reaches over at least `stretch` pixels (its opening).
cv::Mat wideLevels(const cv::Mat& line, int stretch) {
  const cv::Mat bar = line.rows == 1 ? cv::Mat::ones(1, stretch, CV_8U) : cv::Mat::ones(stretch, 1, CV_8U);
  cv::Mat opened;
  cv::morphologyEx(line, opened, cv::MORPH_OPEN, bar, {-1, -1}, 1, cv::BORDER_REPLICATE);
  return opened;
}

/// The wide levels of the four sides, each one pixel inside.
cv::Mat seeds(const cv::Mat& motion, int stretch) {
  cv::Mat seeds = cv::Mat::zeros(motion.size(), CV_32F);
  const cv::Rect lines[] = {{0, 1, motion.cols, 1},
                            {0, motion.rows - 2, motion.cols, 1},
                            {1, 0, 1, motion.rows},
                            {motion.cols - 2, 0, 1, motion.rows}};
  for (const cv::Rect& line : lines) {
    cv::Mat here = seeds(line);
    cv::max(here, wideLevels(motion(line), stretch), here);
  }
  return seeds;
}

}  // namespace

cv::Mat fractionOfBorderStructure(const cv::Mat& motion, const cv::Mat& unseen, double stretch_px) {
  cv::Mat small, hidden;
  cv::resize(motion, small, {}, 1 / kShrink, 1 / kShrink, cv::INTER_AREA);
  cv::resize(unseen, hidden, small.size(), 0, 0, cv::INTER_NEAREST);
  const cv::Rect seen = cv::boundingRect(hidden == 0);
  if (std::min(seen.width, seen.height) < kLeastSide_px) return cv::Mat::zeros(motion.size(), CV_32F);
  const cv::Mat limit = small(seen);
  const int stretch = std::max(1, static_cast<int>(std::lround(stretch_px / kShrink)));
  cv::Mat level = seeds(limit, stretch);
  reconstruct(limit, level);
  cv::Mat whole = cv::Mat::zeros(small.size(), CV_32F);
  level.copyTo(whole(seen));
  cv::resize(whole, whole, motion.size(), 0, 0, cv::INTER_LINEAR);
  constexpr double kNone = 1e-3;  // less evidence counts as none, and its fraction is 0
  return cv::min(whole / (motion + kNone), 1);
}

}  // namespace redbee
