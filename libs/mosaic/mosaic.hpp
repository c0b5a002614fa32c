// The ground as one image, from images of a flight whose way to a map of the ground is known.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "redbee/mosaic/ground_chain.hpp"

namespace redbee {

/// The mosaic's pixels on the map.
struct MosaicGrid {
  Eigen::Vector2d origin;  ///< of pixel (0, 0), in the map's unit
  double units_per_px = 1;
  cv::Size size;             ///< px
  double coarsest_area = 0;  ///< of an image's pixel on the map that is still used, square units

  Eigen::Vector2d pixelOf(const Eigen::Vector2d& on_map) const { return (on_map - origin) / units_per_px; }
};

/// Square units of the map that a pixel of an image covers; infinite at and beyond the horizon.
double areaOnMap(const Eigen::Matrix3d& to_map, const Eigen::Vector2d& pixel, cv::Size image);

/// As fine as the reference frame's centre, coarser where a side would exceed `most_px`. What a frame shows
/// more than three times coarser (towards the horizon) is left out. std::nullopt if nothing is left.
std::optional<MosaicGrid> gridFor(const GroundFrames& frames, cv::Size image, int most_px);

/// Each pixel is a mean of all frames that show it, the finer the heavier.
class Mosaic {
 public:
  explicit Mosaic(const MosaicGrid& grid);

  /// Before add(), where the grid was not made for all frames: it grows, in steps, to what this one shows,
  /// with no side above `most_px`: where one would be, every pixel becomes twice as coarse. From a greater
  /// height coarser pixels are used. Returns false, and does nothing, for what lies so far off that it can be
  /// no neighbour of the frames before.
  bool makeRoomFor(const Eigen::Matrix3d& to_map, cv::Size image, int most_px);

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
  void grow(const Eigen::Array2i& before, const Eigen::Array2i& behind);

  MosaicGrid grid_;
  cv::Mat3f sum_;
  cv::Mat1f weight_;
};

}  // namespace redbee
