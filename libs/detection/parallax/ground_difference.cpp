#include "redbee/detection/parallax/ground_difference.hpp"

#include <algorithm>
#include <array>

#include "redbee/detection/parallax/ground_difference_kernels.hpp"

namespace redbee {
namespace {

constexpr std::array<double, 3> kAges_s{1.0 / 6, 1.0 / 3, 0.5};
constexpr double kSpacing_s = 1.0 / 12;  // of the images that are kept
constexpr double kTimeTolerance = 0.9;
constexpr float kNoise = 6;           // grey levels
constexpr float kTolerance_px = 0.6;  // of the registration
constexpr int kTile_px = 16;          // of a row that is computed together

}  // namespace

const cv::Mat1b& GroundDifference::learn(CameraTime time, const cv::Mat1b& grey, const Eigen::Matrix3d& K) {
  const cv::Size size = grey.size();
  image_ = grey;
  earlier_.clear();
  const EarlierFrame* last = nullptr;
  for (const double age_s : kAges_s) {
    const EarlierFrame* const frame = frames_.aged(time, age_s);
    if (frame == nullptr || frame == last || frame->grey.size() != size) continue;
    last = frame;
    earlier_.emplace_back(*frame, K);
  }
  map_.create(size);
  done_.create(size.height, (size.width + kTile_px - 1) / kTile_px);
  done_.setTo(earlier_.empty() ? 1 : 0);
  if (earlier_.empty()) map_.setTo(0);
  grey_.resize(static_cast<size_t>(size.width));
  unknown_.resize(grey_.size());
  variance_.resize(grey_.size());
  const EarlierFrame* const newest = frames_.newest();
  if (newest == nullptr || seconds(time - newest->time) >= kTimeTolerance * kSpacing_s) {
    frames_.store(time, grey, K, kAges_s.back());
  }
  return map_;
}

void GroundDifference::complete(const cv::Rect& part) {
  const cv::Rect inside = part & cv::Rect({}, map_.size());
  const int begin = inside.x / kTile_px, end = (inside.br().x + kTile_px - 1) / kTile_px;
  for (int y = inside.y; y < inside.br().y; ++y) {
    uint8_t* const done = done_[y];
    for (int first = begin; first < end; ++first) {
      int next = first;
      while (next < end && done[next] == 0) done[next++] = 1;
      if (next == first) continue;
      compute(y, first * kTile_px, std::min(next * kTile_px, map_.cols));
      first = next;  // which is done already
    }
  }
}

/// Pixels [begin, end) of a row.
void GroundDifference::compute(int y, int begin, int end) {
  constexpr float kSobelSum = 8;
  constexpr float kPerSquare = kTolerance_px * kTolerance_px / (kSobelSum * kSobelSum);
  const int last = image_.rows - 1, next = std::min(1, last);
  uint8_t* const least = map_[y];
  std::fill(least + begin, least + end, uint8_t{255});
  varianceOfRow(
      {image_[y > 0 ? y - 1 : next], image_[y], image_[y < last ? y + 1 : last - next], image_.cols},
      {kNoise * kNoise, kPerSquare}, begin, end, variance_.data());
  for (ImageAlignment& earlier : earlier_) {
    earlier.alignRow(y, begin, end, grey_.data(), unknown_.data());
    keepLesser({image_[y], grey_.data(), unknown_.data(), variance_.data()}, begin, end, least);
  }
  // As in alignImage(), nothing is known at the border.
  if (y == 0 || y == last) std::fill(least + begin, least + end, uint8_t{0});
  if (begin == 0) least[0] = 0;
  if (end == image_.cols) least[end - 1] = 0;
}

}  // namespace redbee
