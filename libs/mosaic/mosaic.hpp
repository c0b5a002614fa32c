// The ground as one image, from images of a flight whose way to a map of the ground is known.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "redbee/mosaic/mosaic_grid.hpp"

namespace redbee {

/// Each pixel is a mean of all frames that show it, the finer the heavier.
class Mosaic {
 public:
  explicit Mosaic(const MosaicGrid& grid);

  /// Before add(), where the grid was not made for all frames: it grows, in steps, to what this one shows,
  /// with no side above `most_px`. Where one would be, every pixel becomes twice as coarse, as long as this
  /// frame takes a quarter of the longest side then; after that, what lies on the other side is cut off. From
  /// a greater height coarser pixels are used. Returns false, and does nothing, for what lies so far off that
  /// it can be no neighbour of the frames before, and for what would be a few pixels, as after a descent.
  bool makeRoomFor(const Eigen::Matrix3d& to_map, cv::Size image, int most_px);
  /// Ground that was shown has been cut off.
  bool isCut() const { return is_cut_; }
  /// What is added from now on replaces what was there, as of a map that is laid anew.
  void fade();

  /// `image`: BGR, ideal camera; `left_out`: of its size, not 0 where a pixel is not ground (movers, unknown
  /// pixels).
  void add(const cv::Mat3b& image, const cv::Mat1b& left_out, const Eigen::Matrix3d& to_map);

  /// BGR; black where no frame shows the ground.
  cv::Mat3b image() const;
  /// 255 where a frame shows the ground.
  cv::Mat1b known() const;
  const MosaicGrid& grid() const { return grid_; }

 private:
  void halve();
  /// To this part of its pixels, which may lie beyond them.
  void moveTo(const cv::Rect& part);

  MosaicGrid grid_;
  cv::Mat3f sum_;
  cv::Mat1f weight_;
  bool is_cut_ = false;
};

}  // namespace redbee
