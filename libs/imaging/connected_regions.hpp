// Connected regions of a mask, by runs of pixels: where little is set, a fraction of the cost of
// cv::connectedComponentsWithStats(), and the same regions in the same order.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace redbee {

/// Pixels that are not 0 and touch, also by a corner.
class ConnectedRegions {
 public:
  explicit ConnectedRegions(const cv::Mat1b& mask);

  size_t size() const { return regions_.size(); }
  const cv::Rect& box(size_t region) const { return regions_[region].box; }
  /// px^2
  int area(size_t region) const { return regions_[region].area_px; }
  /// 255 where the region is, in its box. Those of several regions share a piece of memory.
  cv::Mat1b pixels(size_t region) const;

 private:
  struct Run {
    int y, begin, end;
    int region;     ///< while they are joined: a run of the same region that came before, or this one
    int next = -1;  ///< run of the region; -1: none
  };
  struct Region {
    cv::Rect box;
    int area_px;
    cv::Point block;  ///< the first of two times two pixels, by rows: these decide the order
    int first, last;  ///< runs
  };

  void addRow(const uint8_t* row, int y, int width);
  int first(int run) const;
  void join(int a, int b);
  void gather();
  cv::Mat1b room(const cv::Size& size) const;

  std::vector<Run> runs_;
  size_t row_ = 0, row_above_ = 0;  ///< the first runs of the row, and of the one above it
  std::vector<Region> regions_;
  mutable cv::Mat1b memory_;  ///< a row: the newest piece, of which some is in use
  mutable int used_ = 0;
};

}  // namespace redbee
