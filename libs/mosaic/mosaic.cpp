#include "redbee/mosaic/mosaic.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <opencv2/core/eigen.hpp>
#include <opencv2/imgproc.hpp>

namespace redbee {
namespace {

constexpr double kCoarsest = 3;     ///< times the side of the reference's pixel
constexpr int kSamples = 16;        ///< along a side of the image, to see what it covers
constexpr int kBorder_px = 2;       ///< of an image, where rectification and interpolation end
constexpr int kSteps = 16;          ///< in which a growing side comes to its most pixels
constexpr int kMostHalvings = 3;    ///< for one frame: more is a homography that is wrong
constexpr double kSteepest = 0.27;  ///< sin e / (1 + sin^2 e) 17 degrees below the horizon

/// Of a pixel that covers so many of the mosaic's, once it is finer. Exponent 0 would give a plain mean, the
/// larger the more the finest frame alone.
double heavinessOf(double density) { return density * std::sqrt(density); }
constexpr double kHeavierOnceHalved = 8;  // heavinessOf(4)

/// Of the third coordinate below the horizon, where the lower edge's middle lies.
double signOf(const Eigen::Matrix3d& to_map, cv::Size image) {
  const Eigen::Vector2d below(0.5 * image.width, image.height);
  return (to_map.row(2) * below.homogeneous()).value() < 0 ? -1 : 1;
}

struct Bounds {
  Eigen::Vector2d low{INFINITY, INFINITY};
  Eigen::Vector2d high{-INFINITY, -INFINITY};
  void add(const Eigen::Vector2d& point) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  bool empty() const { return !(low.x() < high.x() && low.y() < high.y()); }
};

/// Of what the image shows no coarser than this.
void addCovered(const Eigen::Matrix3d& to_map, cv::Size image, double coarsest_area, Bounds& bounds) {
  for (int i = 0; i <= kSamples; ++i) {
    for (int j = 0; j <= kSamples; ++j) {
      const Eigen::Vector2d pixel(image.width * i / static_cast<double>(kSamples),
                                  image.height * j / static_cast<double>(kSamples));
      if (areaOnMap(to_map, pixel, image) <= coarsest_area)
        bounds.add((to_map * pixel.homogeneous()).eval().hnormalized());
    }
  }
}

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

MosaicGrid halved(MosaicGrid grid) {
  grid.origin += 0.5 * grid.units_per_px * Eigen::Vector2d::Ones();
  grid.units_per_px *= 2;
  grid.size = {(grid.size.width + 1) / 2, (grid.size.height + 1) / 2};
  return grid;
}

}  // namespace

double areaOnMap(const Eigen::Matrix3d& to_map, const Eigen::Vector2d& pixel, cv::Size image) {
  const double w = signOf(to_map, image) * (to_map.row(2) * pixel.homogeneous()).value();
  return w > 0 ? std::abs(to_map.determinant()) / (w * w * w) : INFINITY;
}

std::optional<MosaicGrid> gridFor(const GroundFrames& frames, cv::Size image, int most_px) {
  if (frames.frames.empty()) return std::nullopt;
  const Eigen::Vector2d centre(0.5 * image.width, 0.5 * image.height);
  const double area = areaOnMap(frames.reference, centre, image);
  if (!std::isfinite(area)) return std::nullopt;
  MosaicGrid grid;
  grid.coarsest_area = area * kCoarsest * kCoarsest;
  Bounds bounds;
  for (const MappedFrame& frame : frames.frames) addCovered(frame.to_map, image, grid.coarsest_area, bounds);
  if (bounds.empty()) return std::nullopt;
  const Eigen::Vector2d extent = bounds.high - bounds.low;
  grid.units_per_px = std::max(std::sqrt(area), extent.maxCoeff() / most_px);
  grid.origin = bounds.low;
  grid.size = {std::max(1, static_cast<int>(extent.x() / grid.units_per_px)),
               std::max(1, static_cast<int>(extent.y() / grid.units_per_px))};
  return grid;
}

Mosaic::Mosaic(const MosaicGrid& grid)
    : grid_(grid), sum_(grid.size, cv::Vec3f::all(0)), weight_(grid.size, 0.0F) {}

bool Mosaic::makeRoomFor(const Eigen::Matrix3d& to_map, cv::Size image, int most_px) {
  const double coarsest_area = std::max(grid_.coarsest_area, coarsestAreaOf(to_map, image));
  Bounds bounds;
  addCovered(to_map, image, coarsest_area, bounds);
  if (bounds.empty()) return false;
  const int step = std::max(1, most_px / kSteps);
  for (int halvings = 0; halvings <= kMostHalvings; ++halvings) {
    MosaicGrid grid = grid_;
    for (int i = 0; i < halvings; ++i) grid = halved(grid);
    // Whole steps to the left and above, to the right and below.
    const Eigen::Vector2d size(grid.size.width, grid.size.height);
    const Eigen::Array2d before = (-grid.pixelOf(bounds.low).array() / step).ceil().max(0) * step;
    const Eigen::Array2d behind = ((grid.pixelOf(bounds.high) - size).array() / step).ceil().max(0) * step;
    if ((size.array() + before + behind).maxCoeff() > most_px) continue;
    for (int i = 0; i < halvings; ++i) halve();
    grid_.coarsest_area = coarsest_area;
    grow(before.cast<int>(), behind.cast<int>());
    return true;
  }
  return false;
}

void Mosaic::grow(const Eigen::Array2i& before, const Eigen::Array2i& behind) {
  if ((before == 0).all() && (behind == 0).all()) return;
  cv::copyMakeBorder(sum_, sum_, before.y(), behind.y(), before.x(), behind.x(), cv::BORDER_CONSTANT);
  cv::copyMakeBorder(weight_, weight_, before.y(), behind.y(), before.x(), behind.x(), cv::BORDER_CONSTANT);
  grid_.origin -= grid_.units_per_px * before.matrix().cast<double>();
  grid_.size = sum_.size();
}

/// Of four pixels one, in their middle, with what was added to them at its own size.
void Mosaic::halve() {
  grid_ = halved(grid_);
  for (cv::Mat* image : {static_cast<cv::Mat*>(&sum_), static_cast<cv::Mat*>(&weight_)}) {
    cv::copyMakeBorder(*image, *image, 0, image->rows % 2, 0, image->cols % 2, cv::BORDER_CONSTANT);
    cv::resize(*image, *image, grid_.size, 0, 0, cv::INTER_AREA);
    *image *= kHeavierOnceHalved;
  }
}

void Mosaic::add(const cv::Mat3b& image, const cv::Mat1b& left_out, const Eigen::Matrix3d& to_map) {
  Bounds bounds;
  addCovered(to_map, image.size(), grid_.coarsest_area, bounds);
  if (bounds.empty()) return;
  const Eigen::Vector2d low = grid_.pixelOf(bounds.low).array().floor();
  const Eigen::Vector2d high = grid_.pixelOf(bounds.high).array().ceil();
  const cv::Rect region =
      cv::Rect(cv::Point(static_cast<int>(low.x()), static_cast<int>(low.y())),
               cv::Point(static_cast<int>(high.x()) + 1, static_cast<int>(high.y()) + 1)) &
      cv::Rect({0, 0}, grid_.size);
  if (region.empty()) return;

  Eigen::Matrix3d map_to_region;
  const Eigen::Vector2d corner = grid_.origin + grid_.units_per_px * Eigen::Vector2d(region.x, region.y);
  map_to_region << 1, 0, -corner.x(), 0, 1, -corner.y(), 0, 0, grid_.units_per_px;
  const Eigen::Matrix3d to_region = map_to_region * to_map;
  cv::Matx33d transform;
  cv::eigen2cv(to_region, transform);
  cv::Mat1b usable = cv::Mat1b::zeros(image.size());
  usable(cv::Rect({kBorder_px, kBorder_px}, image.size() - cv::Size(2 * kBorder_px, 2 * kBorder_px))) = 255;
  usable.setTo(0, left_out);
  cv::Mat3b warped;
  cv::Mat1b shown;
  cv::warpPerspective(image, warped, transform, region.size(), cv::INTER_LINEAR);
  cv::warpPerspective(usable, shown, transform, region.size(), cv::INTER_NEAREST);

  const Eigen::Matrix3d back = to_region.inverse();  // from the region's pixels to the image's
  const double determinant = std::abs(back.determinant());
  const double sign = signOf(to_map, image.size());
  const double least_density = grid_.units_per_px * grid_.units_per_px / grid_.coarsest_area;
  for (int y = 0; y < region.height; ++y) {
    cv::Vec3f* sum = sum_[region.y + y] + region.x;
    float* weight = weight_[region.y + y] + region.x;
    for (int x = 0; x < region.width; ++x) {
      if (shown(y, x) == 0) continue;
      const double w = back(2, 0) * x + back(2, 1) * y + back(2, 2);
      const double density = determinant / std::abs(w * w * w);  // pixels of the image in one of the mosaic
      if (!(sign * w > 0) || density < least_density) continue;  // beyond the horizon, or near it
      const auto heaviness = static_cast<float>(heavinessOf(std::min(density, 100.0)));
      sum[x] += heaviness * cv::Vec3f(warped(y, x));
      weight[x] += heaviness;
    }
  }
}

cv::Mat3b Mosaic::image() const {
  cv::Mat3b result(grid_.size, cv::Vec3b::all(0));
  for (int y = 0; y < result.rows; ++y) {
    for (int x = 0; x < result.cols; ++x) {
      if (weight_(y, x) > 0) result(y, x) = cv::Vec3b(sum_(y, x) / weight_(y, x));
    }
  }
  return result;
}

cv::Mat1b Mosaic::known() const { return weight_ > 0; }

}  // namespace redbee
