// Where the pixels of a mosaic lie on the map, and how its grid grows with a flight.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <opencv2/core.hpp>
#include <optional>

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

/// The same ground with pixels twice as coarse.
MosaicGrid halved(MosaicGrid grid);

/// A part of the map, along its axes.
struct GroundBounds {
  Eigen::Vector2d low{INFINITY, INFINITY};
  Eigen::Vector2d high{-INFINITY, -INFINITY};
  void add(const Eigen::Vector2d& point) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  void add(const GroundBounds& other) {
    low = low.cwiseMin(other.low);
    high = high.cwiseMax(other.high);
  }
  bool empty() const { return !(low.x() < high.x() && low.y() < high.y()); }
};
/// Of what the image shows no coarser than this, square units.
GroundBounds boundsOf(const Eigen::Matrix3d& to_map, cv::Size image, double coarsest_area);
/// Of the third coordinate below the horizon, where the lower edge's middle lies: 1 or -1.
double signBelowHorizon(const Eigen::Matrix3d& to_map, cv::Size image);

/// How a grid makes room for one more frame.
struct MosaicRoom {
  int halvings = 0;          ///< halved() first
  cv::Rect part;             ///< of the pixels then, to keep; it may lie beyond them
  double coarsest_area = 0;  ///< see MosaicGrid
};
/// See Mosaic::makeRoomFor().
std::optional<MosaicRoom> roomFor(const MosaicGrid& grid, const Eigen::Matrix3d& to_map, cv::Size image,
                                  int most_px);

}  // namespace redbee
