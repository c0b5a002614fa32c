// A known texture on flat ground, seen on a known path: the mosaic is the texture, at its scale, without what
// moved.
#include "redbee/mosaic/mosaic.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <opencv2/core/eigen.hpp>
#include <opencv2/imgproc.hpp>

#include "redbee/geometry/so3.hpp"
#include "tests/support/camera.hpp"

namespace redbee::test {
namespace {

constexpr double kTexel_m = 0.02;
constexpr int kTexels = 2000;
constexpr int kFrames = 24;

/// The ground's coordinates are metres east and north, the texture's middle is the origin.
class MosaicTest : public testing::Test {
 protected:
  MosaicTest() : texture_(kTexels, kTexels) {
    cv::RNG rng(3);
    rng.fill(texture_, cv::RNG::UNIFORM, 0, 255);
    cv::GaussianBlur(texture_, texture_, {0, 0}, 8);
    cv::normalize(texture_, texture_, 20, 235, cv::NORM_MINMAX);
  }

  /// From the ground to ideal pixels; the camera looks 50 degrees down, yaws and flies 6 m along.
  static Eigen::Matrix3d toPixels(int k) {
    const Eigen::Matrix3d R_CG = rotation(k).transpose();
    const Eigen::Vector3d p = position(k);
    Eigen::Matrix3d columns;
    columns << Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), -p;
    return camera().K() * R_CG * columns;
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
      const cv::Rect square(kTexels / 2 + 3 * k, kTexels / 2 + 10 * k, 75, 75);
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
        const cv::Point2f at(static_cast<float>(g.x() / kTexel_m + kTexels / 2),
                             static_cast<float>(g.y() / kTexel_m + kTexels / 2));
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

TEST_F(MosaicTest, TheMapIsInMetresAndHasNoShear) {
  const Eigen::Matrix3d map = groundMap(camera().K_inverse(), plane(5)) * toPixels(5);
  const Eigen::Matrix3d scaled = map / map(2, 2);
  EXPECT_NEAR(scaled.row(2).head<2>().norm(), 0, 1e-9);
  const Eigen::Matrix2d axes = scaled.topLeftCorner<2, 2>();
  EXPECT_LT((axes.transpose() * axes - Eigen::Matrix2d::Identity()).norm(), 1e-9);
}

TEST_F(MosaicTest, IsTheTextureWithoutWhatMoved) {
  const auto piece = chain().longestPiece();
  ASSERT_EQ(piece.size(), static_cast<size_t>(kFrames));
  const GroundFrames frames = mapped(piece, camera().K());
  ASSERT_TRUE(frames.is_metric);
  const auto grid = gridFor(frames, {kWidth, kHeight}, 4000);
  ASSERT_TRUE(grid);
  // A pixel of the image's centre: the square root of its area on the ground, by the distance and the
  // depression.
  const double distance = 10 / std::sin(50 * M_PI / 180);
  EXPECT_NEAR(grid->units_per_px, distance / 500 / std::sqrt(std::sin(50 * M_PI / 180)), 1e-3);
  Mosaic mosaic(*grid);
  Mosaic without_masks(*grid);
  for (int k = 0; k < kFrames; ++k) {
    const auto [image, mask] = view(k, true);
    mosaic.add(image, mask, frames.frames[static_cast<size_t>(k)].to_map);
    without_masks.add(image, cv::Mat1b::zeros(mask.size()), frames.frames[static_cast<size_t>(k)].to_map);
  }
  const auto [mean, worst] = difference(mosaic, *grid, frames, kFrames / 2);
  std::printf("mean %.2f worst %.2f\n", mean, worst);
  EXPECT_LT(mean, 2);
  EXPECT_LT(worst, 25);
  EXPECT_GT(difference(without_masks, *grid, frames, kFrames / 2).second, 2 * worst + 20)
      << "the mover leaves a trace";
}

TEST_F(MosaicTest, TakesTheLongestPieceOfABrokenFlight) {
  const GroundChain broken = chain(9);
  EXPECT_EQ(broken.pieces(), 2U);
  const auto piece = broken.longestPiece();
  EXPECT_EQ(piece.size(), static_cast<size_t>(kFrames - 9));
  EXPECT_EQ(piece.front().utime, utime(9));
}

TEST_F(MosaicTest, EndsBelowTheHorizon) {
  // Level: the horizon is in the middle of the image, half of it shows no ground.
  Eigen::Matrix3d R_CG;
  R_CG << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  GroundChain level;
  level.addStep(1, 2, Eigen::Matrix3d::Identity());
  const Eigen::Matrix3d pitched = expSO3({20 * M_PI / 180, 0, 0}) * R_CG;
  level.setPlane(1, {pitched * Eigen::Vector3d(0, 0, -1), 10});
  const GroundFrames frames = mapped(level.longestPiece(), camera().K());
  const auto grid = gridFor(frames, {kWidth, kHeight}, 4000);
  ASSERT_TRUE(grid);
  // Three times the side of the centre's pixel: 3^(2/3) times its distance along the ground at most.
  const double farthest = std::pow(3.0, 2.0 / 3) * 10 / std::sin(20 * M_PI / 180);
  EXPECT_LT(grid->size.height * grid->units_per_px, farthest);
  EXPECT_FALSE(gridFor({}, {kWidth, kHeight}, 4000));
}

TEST_F(MosaicTest, APixelCoversWhatItSeesOfTheGroundAndBeyondTheHorizonAllOfIt) {
  constexpr double kHeight_m = 10;
  Eigen::Matrix3d R_CG;  // level: the horizon is the image's middle row
  R_CG << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  const Eigen::Matrix3d to_map =
      groundMap(camera().K_inverse(), {R_CG * Eigen::Vector3d(0, 0, -1), kHeight_m});
  const Eigen::Matrix3d K = camera().K();
  for (const double below_px : {20.0, 100.0}) {
    // The map's point: fx h / v to the front, h / v to the side for each pixel.
    const double side = kHeight_m / below_px, front = K(1, 1) * kHeight_m / (below_px * below_px);
    const Eigen::Vector2d pixel(K(0, 2), K(1, 2) + below_px);
    EXPECT_NEAR(areaOnMap(to_map, pixel, {kWidth, kHeight}), side * front * K(1, 1) / K(0, 0), 1e-9);
  }
  EXPECT_TRUE(std::isinf(areaOnMap(to_map, {K(0, 2), K(1, 2) - 20}, {kWidth, kHeight})));
}

TEST_F(MosaicTest, WithoutAPlaneIsInPixelsOfTheMiddleFrame) {
  GroundChain pixels;
  pixels.addStep(1, 2, Eigen::Matrix3d::Identity());
  pixels.addStep(2, 3, Eigen::Matrix3d::Identity());
  const GroundFrames frames = mapped(pixels.longestPiece(), camera().K());
  EXPECT_FALSE(frames.is_metric);
  const auto grid = gridFor(frames, {kWidth, kHeight}, 4000);
  ASSERT_TRUE(grid);
  EXPECT_EQ(grid->size, cv::Size(kWidth, kHeight));
  EXPECT_DOUBLE_EQ(grid->units_per_px, 1);
  EXPECT_LE(gridFor(frames, {kWidth, kHeight}, 320)->size.width, 320);
}

}  // namespace
}  // namespace redbee::test
