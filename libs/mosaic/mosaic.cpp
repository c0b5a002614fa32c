#include "redbee/mosaic/mosaic.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <opencv2/core/eigen.hpp>
#include <opencv2/imgproc.hpp>

namespace redbee {
namespace {

constexpr int kBorder_px = 2;  ///< of an image, where rectification and interpolation end
constexpr float kFaded = 1.0F / 64;

/// Of a pixel that covers so many of the mosaic's, once it is finer. Exponent 0 would give a plain mean, the
/// larger the more the finest frame alone.
double heavinessOf(double density) { return density * std::sqrt(density); }
constexpr double kHeavierOnceHalved = 8;  // heavinessOf(4)

}  // namespace

Mosaic::Mosaic(const MosaicGrid& grid)
    : grid_(grid), sum_(grid.size, cv::Vec3f::all(0)), weight_(grid.size, 0.0F) {}

bool Mosaic::makeRoomFor(const Eigen::Matrix3d& to_map, cv::Size image, int most_px) {
  const auto room = roomFor(grid_, to_map, image, most_px);
  if (!room) return false;
  for (int i = 0; i < room->halvings; ++i) halve();
  grid_.coarsest_area = room->coarsest_area;
  moveTo(room->part);
  return true;
}

void Mosaic::moveTo(const cv::Rect& part) {
  const cv::Rect whole({0, 0}, grid_.size);
  if (part == whole) return;
  const cv::Rect kept = part & whole;
  const int known = cv::countNonZero(weight_);
  for (cv::Mat* image : {static_cast<cv::Mat*>(&sum_), static_cast<cv::Mat*>(&weight_)}) {
    cv::Mat moved = cv::Mat::zeros(part.size(), image->type());
    if (!kept.empty()) (*image)(kept).copyTo(moved(kept - part.tl()));
    *image = moved;
  }
  is_cut_ = is_cut_ || cv::countNonZero(weight_) < known;
  grid_.origin += grid_.units_per_px * Eigen::Vector2d(part.x, part.y);
  grid_.size = part.size();
}

void Mosaic::fade() {
  for (int y = 0; y < weight_.rows; ++y) {
    for (int x = 0; x < weight_.cols; ++x) {
      float& weight = weight_(y, x);
      if (weight <= kFaded) continue;
      sum_(y, x) *= kFaded / weight;
      weight = kFaded;
    }
  }
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
  const GroundBounds bounds = boundsOf(to_map, image.size(), grid_.coarsest_area);
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
  const double sign = signBelowHorizon(to_map, image.size());
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
