// A known texture on flat ground, seen on a known path.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <opencv2/core/eigen.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "redbee/geometry/so3.hpp"
#include "redbee/mosaic/mosaic.hpp"
#include "tests/support/camera.hpp"

namespace redbee::test {

inline constexpr double kTexel_m = 0.02;
inline constexpr int kTexels = 2000;
inline constexpr int kFrames = 24;

/// The ground's coordinates are metres east and north, the texture's middle is the origin.
class TexturedGround : public testing::Test {
 protected:
  TexturedGround() : texture_(kTexels, kTexels) {
    cv::RNG rng(3);
    rng.fill(texture_, cv::RNG::UNIFORM, 0, 255);
    cv::GaussianBlur(texture_, texture_, {0, 0}, 8);
    cv::normalize(texture_, texture_, 20, 235, cv::NORM_MINMAX);
  }

  /// From the ground to ideal pixels; the camera looks 50 degrees down, yaws and flies 6 m along.
  static Eigen::Matrix3d toPixels(int k) { return toPixels(rotation(k), position(k)); }
  static Eigen::Matrix3d toPixels(const Eigen::Matrix3d& R_GC, const Eigen::Vector3d& p) {
    Eigen::Matrix3d columns;
    columns << Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), -p;
    return camera().K() * R_GC.transpose() * columns;
  }
  static Eigen::Matrix3d rotation(int k) {
    Eigen::Matrix3d north;  // looks to the north, level
    north << 1, 0, 0, 0, 0, 1, 0, -1, 0;
    return expSO3({0, 0, 0.02 * k}) * north * expSO3({-50 * M_PI / 180, 0, 0});
  }
  static Eigen::Vector3d position(int k) { return {-1 + 0.25 * k, -8 + 0.05 * k, 10}; }
  static int64_t utime(int k) { return 1'000'000 + 40'000 * k; }

  static GroundPlane plane(int k) {
    return {rotation(k).transpose() * Eigen::Vector3d(0, 0, -1), position(k).z()};
  }

  static GroundChain chain(int broken_at = -1) {
    GroundChain chain;
    for (int k = 1; k < kFrames; ++k) {
      if (k == broken_at) continue;
      chain.addStep(utime(k - 1), utime(k), toPixels(k) * toPixels(k - 1).inverse());
      chain.setPlane(utime(k - 1), plane(k - 1));
    }
    return chain;
  }

  /// With a white square of 1.5 m that moves over the ground, and where it is.
  std::pair<cv::Mat3b, cv::Mat1b> view(int k, bool has_mover) const {
    Eigen::Matrix3d from_texture;
    from_texture << kTexel_m, 0, -kTexels * kTexel_m / 2, 0, kTexel_m, -kTexels * kTexel_m / 2, 0, 0, 1;
    cv::Mat1b ground = texture_.clone();
    cv::Mat1b where = cv::Mat1b::zeros(texture_.size());
    if (has_mover) {
      const cv::Rect square(kTexels / 2.0 + 3 * k, kTexels / 2.0 + 10 * k, 75, 75);
      ground(square) = 255;
      where(square) = 255;
    }
    cv::Matx33d transform;
    cv::eigen2cv((toPixels(k) * from_texture).eval(), transform);
    cv::Mat1b image;
    cv::Mat1b mask;
    cv::warpPerspective(ground, image, transform, {kWidth, kHeight}, cv::INTER_AREA);
    cv::warpPerspective(where, mask, transform, {kWidth, kHeight}, cv::INTER_NEAREST);
    cv::dilate(mask, mask, cv::Mat1b::ones(5, 5));
    cv::Mat3b colour;
    cv::cvtColor(image, colour, cv::COLOR_GRAY2BGR);
    return {colour, mask};
  }

  /// Mean difference from the texture [grey levels]; and the worst one.
  std::pair<double, double> difference(const Mosaic& mosaic, const MosaicGrid& grid,
                                       const GroundFrames& frames, int reference) const {
    const Eigen::Matrix3d to_ground = (frames.reference * toPixels(reference)).inverse();
    const cv::Mat3b image = mosaic.image();
    const cv::Mat1b known = mosaic.known();
    double sum = 0;
    double worst = 0;
    int count = 0;
    for (int y = 0; y < image.rows; y += 3) {
      for (int x = 0; x < image.cols; x += 3) {
        if (known(y, x) == 0) continue;
        const Eigen::Vector2d on_map = grid.origin + grid.units_per_px * Eigen::Vector2d(x, y);
        const Eigen::Vector2d g = (to_ground * on_map.homogeneous()).eval().hnormalized();
        cv::Mat1f texel;
        const cv::Point2f at(static_cast<float>(g.x() / kTexel_m + kTexels / 2.0),
                             static_cast<float>(g.y() / kTexel_m + kTexels / 2.0));
        cv::getRectSubPix(texture_, {1, 1}, at, texel, CV_32F);
        const double off = std::abs(image(y, x)[0] - texel(0, 0));
        sum += off;
        worst = std::max(worst, off);
        ++count;
      }
    }
    EXPECT_GT(count, 10000);
    return {sum / count, worst};
  }

  cv::Mat1b texture_;
};

}  // namespace redbee::test
