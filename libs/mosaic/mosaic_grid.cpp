#include "redbee/mosaic/mosaic_grid.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace redbee {
namespace {

constexpr double kCoarsest = 3;      ///< times the side of the reference's pixel
constexpr int kSamples = 16;         ///< along a side of the image, to see what it covers
constexpr int kSteps = 16;           ///< in which a growing side comes to its most pixels
constexpr int kMostHalvings = 3;     ///< for one frame: more is a homography that is wrong
constexpr double kSteepest = 0.27;   ///< sin e / (1 + sin^2 e) 17 degrees below the horizon
constexpr double kMostPixels = 1e8;  ///< beyond any grid
/// Of the longest side, that the newest frame takes at least when pixels become coarser.
constexpr double kLeastShare = 0.25;
constexpr double kNoShare = 0.08;  ///< of its own size, or of the longest side: a smaller one is not seen

/// What is still used of a frame that looks down steeply enough; 0 of another. Its finest pixel decides, on
/// the map as long as it is wide and sin e as high, e below the horizon.
double coarsestAreaOf(const Eigen::Matrix3d& to_map, cv::Size image) {
  double least = INFINITY;
  Eigen::Vector2d finest(0, 0);
  for (const double x : {0.0, 0.5, 1.0}) {
    for (const double y : {0.0, 0.5, 1.0}) {
      const Eigen::Vector2d pixel(x * image.width, y * image.height);
      const double area = areaOnMap(to_map, pixel, image);
      if (!(area < least)) continue;
      least = area;
      finest = pixel;
    }
  }
  if (!std::isfinite(least)) return 0;
  const Eigen::Vector3d on_map = to_map * finest.homogeneous();
  const Eigen::Matrix2d J =
      (to_map.topLeftCorner<2, 2>() - on_map.hnormalized() * to_map.row(2).head<2>()) / on_map.z();
  if (least < kSteepest * J.squaredNorm()) return 0;
  return kCoarsest * kCoarsest * least;
}

/// Of a grid that grows, in whole steps, to hold the bounds, on its pixels.
cv::Rect grownTo(const MosaicGrid& grid, const GroundBounds& bounds, int most_px) {
  const int step = std::max(1, most_px / kSteps);
  const Eigen::Array2d size(grid.size.width, grid.size.height);
  const Eigen::Array2d before = (-grid.pixelOf(bounds.low).array() / step).ceil().max(0) * step;
  const Eigen::Array2d behind = ((grid.pixelOf(bounds.high).array() - size) / step).ceil().max(0) * step;
  const Eigen::Array2d whole = (size + before + behind).min(kMostPixels);
  return {-static_cast<int>(std::min(before.x(), kMostPixels)),
          -static_cast<int>(std::min(before.y(), kMostPixels)), static_cast<int>(whole.x()),
          static_cast<int>(whole.y())};
}

bool isWithin(const cv::Rect& room, int most_px) { return std::max(room.width, room.height) <= most_px; }

/// The same with no side above `most_px`: without what lies on the other side. std::nullopt where the bounds
/// do not fit, or lie further off than a whole side.
std::optional<cv::Rect> cutTo(const MosaicGrid& grid, const GroundBounds& bounds, int most_px) {
  cv::Rect room = grownTo(grid, bounds, most_px);
  const Eigen::Vector2d low = grid.pixelOf(bounds.low);
  const Eigen::Vector2d high = grid.pixelOf(bounds.high);
  const Eigen::Array2d size(grid.size.width, grid.size.height);
  if ((low.array() > size + most_px).any() || (high.array() < -most_px).any()) return std::nullopt;
  if (room.width > most_px)
    room = {low.x() < 0 ? room.x : room.br().x - most_px, room.y, most_px, room.height};
  if (room.height > most_px)
    room = {room.x, low.y() < 0 ? room.y : room.br().y - most_px, room.width, most_px};
  const bool is_held =
      low.x() >= room.x && low.y() >= room.y && high.x() <= room.br().x && high.y() <= room.br().y;
  return is_held ? std::optional<cv::Rect>(room) : std::nullopt;
}

}  // namespace

MosaicGrid halved(MosaicGrid grid) {
  grid.origin += 0.5 * grid.units_per_px * Eigen::Vector2d::Ones();
  grid.units_per_px *= 2;
  grid.size = {(grid.size.width + 1) / 2, (grid.size.height + 1) / 2};
  return grid;
}

double signBelowHorizon(const Eigen::Matrix3d& to_map, cv::Size image) {
  const Eigen::Vector2d below(0.5 * image.width, image.height);
  return (to_map.row(2) * below.homogeneous()).value() < 0 ? -1 : 1;
}

double areaOnMap(const Eigen::Matrix3d& to_map, const Eigen::Vector2d& pixel, cv::Size image) {
  const double w = signBelowHorizon(to_map, image) * (to_map.row(2) * pixel.homogeneous()).value();
  return w > 0 ? std::abs(to_map.determinant()) / (w * w * w) : INFINITY;
}

std::optional<MosaicGrid> gridFor(const GroundFrames& frames, cv::Size image, int most_px) {
  if (frames.frames.empty()) return std::nullopt;
  const Eigen::Vector2d centre(0.5 * image.width, 0.5 * image.height);
  const double area = areaOnMap(frames.reference, centre, image);
  if (!std::isfinite(area)) return std::nullopt;
  MosaicGrid grid;
  grid.coarsest_area = area * kCoarsest * kCoarsest;
  GroundBounds bounds;
  for (const MappedFrame& frame : frames.frames)
    bounds.add(boundsOf(frame.to_map, image, grid.coarsest_area));
  if (bounds.empty()) return std::nullopt;
  const Eigen::Vector2d extent = bounds.high - bounds.low;
  grid.units_per_px = std::max(std::sqrt(area), extent.maxCoeff() / most_px);
  grid.origin = bounds.low;
  grid.size = {std::max(1, static_cast<int>(extent.x() / grid.units_per_px)),
               std::max(1, static_cast<int>(extent.y() / grid.units_per_px))};
  return grid;
}

GroundBounds boundsOf(const Eigen::Matrix3d& to_map, cv::Size image, double coarsest_area) {
  GroundBounds bounds;
  for (int i = 0; i <= kSamples; ++i) {
    for (int j = 0; j <= kSamples; ++j) {
      const Eigen::Vector2d pixel(image.width * i / static_cast<double>(kSamples),
                                  image.height * j / static_cast<double>(kSamples));
      if (areaOnMap(to_map, pixel, image) <= coarsest_area)
        bounds.add((to_map * pixel.homogeneous()).eval().hnormalized());
    }
  }
  return bounds;
}

std::optional<MosaicRoom> roomFor(const MosaicGrid& grid, const Eigen::Matrix3d& to_map, cv::Size image,
                                  int most_px) {
  MosaicRoom room;
  room.coarsest_area = std::max(grid.coarsest_area, coarsestAreaOf(to_map, image));
  const GroundBounds bounds = boundsOf(to_map, image, room.coarsest_area);
  if (bounds.empty()) return std::nullopt;
  const double extent = (bounds.high - bounds.low).maxCoeff();
  const int own_px = std::min(std::max(image.width, image.height), most_px);
  if (extent < kNoShare * own_px * grid.units_per_px) return std::nullopt;
  MosaicGrid coarser = grid;
  for (; !isWithin(grownTo(coarser, bounds, most_px), most_px); coarser = halved(coarser), ++room.halvings) {
    if (extent < 2 * kLeastShare * most_px * coarser.units_per_px) break;
    if (room.halvings == kMostHalvings) return std::nullopt;
  }
  const auto part = cutTo(coarser, bounds, most_px);
  if (!part) return std::nullopt;
  room.part = *part;
  return room;
}

}  // namespace redbee
