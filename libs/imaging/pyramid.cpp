#include "redbee/imaging/pyramid.hpp"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <opencv2/imgproc.hpp>

namespace redbee {
namespace {

PyramidLevel withMargin(const cv::Mat1b& image, int margin) {
  PyramidLevel level;
  level.margin = margin;
  level.width = image.cols;
  level.height = image.rows;
  // Isolated: a region of interest must not use pixels outside of it.
  cv::copyMakeBorder(image, level.padded, margin, margin, margin, margin,
                     cv::BORDER_REFLECT_101 | cv::BORDER_ISOLATED);
  return level;
}

double meanDifference(const cv::Mat1b& from, const cv::Mat1b& to, cv::Point shift, int brightness) {
  const cv::Rect frame(cv::Point(0, 0), from.size());
  const cv::Rect common = frame & (frame - shift);
  int64_t sum = 0;
  for (int y = common.y; y < common.br().y; ++y) {
    const uint8_t* a = from[y];
    const uint8_t* b = to[y + shift.y] + shift.x;
    int row = 0;
    for (int x = common.x; x < common.br().x; ++x) row += std::abs(b[x] - a[x] - brightness);
    sum += row;
  }
  return static_cast<double>(sum) / std::max(1, common.area());
}

}  // namespace

Pyramid::Pyramid(const cv::Mat1b& grey, int levels, int margin, int min_side) {
  cv::Mat1b image = grey;
  while (true) {
    // A mirrored margin cannot be wider than the image itself.
    levels_.push_back(withMargin(image, margin));
    if (size() >= levels || std::min(image.cols, image.rows) / 2 < min_side) return;
    cv::Mat1b half;
    cv::pyrDown(image, half, cv::Size(), cv::BORDER_REFLECT_101);
    image = half;
  }
}

cv::Point bestShift(const PyramidLevel& from, const PyramidLevel& to, int reach) {
  const cv::Mat1b a = from.image();
  const cv::Mat1b b = to.image();
  const int brightness = cvRound(cv::mean(b)[0] - cv::mean(a)[0]);
  const int reach_x = std::min(reach, from.width / 4);
  const int reach_y = std::min(reach, from.height / 4);
  cv::Point best(0, 0);
  double smallest = meanDifference(a, b, best, brightness);
  for (int dy = -reach_y; dy <= reach_y; ++dy) {
    for (int dx = -reach_x; dx <= reach_x; ++dx) {
      const double difference = meanDifference(a, b, {dx, dy}, brightness);
      if (difference >= smallest) continue;
      smallest = difference;
      best = {dx, dy};
    }
  }
  return best;
}

}  // namespace redbee
