// Image pyramid of a grey image; each level has a margin, so that patches may extend beyond the border.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

namespace redbee {

/// One level: pixel (x, y) of level l lies at (x, y) * 2^l of the image.
struct PyramidLevel {
  cv::Mat1b padded;  ///< with a mirrored margin on all sides
  int margin = 0;    ///< px
  int width = 0;     ///< px, without the margin
  int height = 0;    ///< px, without the margin

  /// Address of a pixel; -margin <= x < width + margin, y alike.
  const uint8_t* at(int x, int y) const { return padded.ptr(y + margin) + x + margin; }
  cv::Size size() const { return {width, height}; }
  /// The level without its margin.
  cv::Mat1b image() const { return padded(cv::Rect(margin, margin, width, height)); }
  std::size_t stride() const { return padded.step[0]; }
};

class Pyramid {
 public:
  Pyramid() = default;
  /// Levels whose shorter side would be below `min_side` px are omitted.
  Pyramid(const cv::Mat1b& grey, int levels, int margin, int min_side);

  bool empty() const { return levels_.empty(); }
  int size() const { return static_cast<int>(levels_.size()); }
  const PyramidLevel& operator[](int level) const { return levels_[static_cast<std::size_t>(level)]; }
  void clear() { levels_.clear(); }

 private:
  std::vector<PyramidLevel> levels_;
};

/// Shift [px of this level] that best aligns `from` with `to`: smallest mean absolute difference over all
/// whole-pixel shifts up to `reach` px, after subtracting the mean brightness.
cv::Point bestShift(const PyramidLevel& from, const PyramidLevel& to, int reach);

}  // namespace redbee
