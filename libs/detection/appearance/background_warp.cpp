#include "redbee/detection/appearance/background_warp.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>

namespace redbee {
namespace {

using Pixel = Eigen::Map<Eigen::Array4f>;
using ConstPixel = Eigen::Map<const Eigen::Array4f>;

/// Resamples the maps along a row. Source coordinates are interpolated linearly between knots: over so few
/// pixels the perspective error is below 0.001 px.
class RowWarp {
 public:
  RowWarp(const BackgroundMaps& from, BackgroundMaps& to) : from_(from), to_(to) {}

  /// Pixels begin to end of row y, which `back` maps into the earlier image.
  void warp(const Eigen::Matrix3f& back, int y, int begin, int end) {
    constexpr int kKnot = 16;
    for (int x = begin; x < end; x += kKnot) {
      const int next = std::min(x + kKnot, end);
      const Eigen::Vector2f first = source(back, x, y);
      const Eigen::Vector2f step = (source(back, next, y) - first) / static_cast<float>(next - x);
      for (int i = x; i < next; ++i) sample(first + static_cast<float>(i - x) * step, y, i);
    }
  }

 private:
  static Eigen::Vector2f source(const Eigen::Matrix3f& back, int x, int y) {
    return (back * Eigen::Vector3f(static_cast<float>(x), static_cast<float>(y), 1)).hnormalized();
  }

  void sample(const Eigen::Vector2f& from, int y, int x) {
    // Written so that what is not a number is outside, too.
    const bool inside = from.x() >= 0 && from.y() >= 0 &&
                        from.x() < static_cast<float>(from_.model.cols - 1) &&
                        from.y() < static_cast<float>(from_.model.rows - 1);
    if (!inside) {
      to_.age(y, x) = 0;
      return;
    }
    const int column = static_cast<int>(from.x());
    const int row = static_cast<int>(from.y());
    const float right = from.x() - static_cast<float>(column);
    const float below = from.y() - static_cast<float>(row);
    const float* top = from_.model.ptr<float>(row) + 4 * column;
    const float* bottom = from_.model.ptr<float>(row + 1) + 4 * column;
    const Eigen::Array4f upper = ConstPixel(top) + right * (ConstPixel(top + 4) - ConstPixel(top));
    const Eigen::Array4f lower = ConstPixel(bottom) + right * (ConstPixel(bottom + 4) - ConstPixel(bottom));
    Pixel(to_.model.ptr<float>(y) + 4 * x) = upper + below * (lower - upper);
    const int near_row = row + (below > 0.5F ? 1 : 0);
    const int near_column = column + (right > 0.5F ? 1 : 0);
    to_.age(y, x) = from_.age(near_row, near_column);
    to_.speed(y, x) = from_.speed(near_row, near_column);
  }

  const BackgroundMaps& from_;
  BackgroundMaps& to_;
};

}  // namespace

BackgroundMaps warpBackground(const BackgroundMaps& maps, const SceneMotion& scene) {
  const Eigen::Matrix3f ground = scene.ground.inverse().cast<float>();
  const Eigen::Matrix3f far = scene.far.inverse().cast<float>();
  BackgroundMaps warped{cv::Mat4f::zeros(maps.model.size()), cv::Mat1f::zeros(maps.speed.size()),
                        cv::Mat1b(maps.age.size())};
  RowWarp row_warp(maps, warped);
  for (int y = 0; y < maps.model.rows; ++y) {
    const SceneMotion::HorizonCut cut = scene.cutAtHorizon(y, maps.model.cols);
    row_warp.warp(cut.ground_first ? ground : far, y, 0, cut.at);
    row_warp.warp(cut.ground_first ? far : ground, y, cut.at, maps.model.cols);
  }
  return warped;
}

}  // namespace redbee
