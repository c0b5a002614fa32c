// A known texture on flat ground, seen on a known path: the mosaic is the texture, at its scale, without what
// moved.
#include "tests/mosaic/textured_ground.hpp"

namespace redbee::test {
namespace {

using MosaicTest = TexturedGround;

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
