// A mosaic that begins with one frame and grows: the same ground as on a grid that was made for all frames,
// in bounded space.
#include "tests/mosaic/textured_ground.hpp"

namespace redbee::test {
namespace {

const cv::Size kImage{kWidth, kHeight};

class GrowingMosaic : public TexturedGround {
 protected:
  GrowingMosaic() : frames_(mapped(chain().longestPiece(), camera().K())) {}

  const Eigen::Matrix3d& toMap(int k) const { return frames_.frames[static_cast<size_t>(k)].to_map; }
  Mosaic begun(int k, int most_px = 4000) const {
    return Mosaic(*gridFor({{frames_.frames[static_cast<size_t>(k)]}, true, toMap(k)}, kImage, most_px));
  }
  /// Of the path from its first frame on.
  Mosaic grown(int most_px) const {
    Mosaic mosaic = begun(0, most_px);
    for (int k = 0; k < kFrames; ++k) {
      EXPECT_TRUE(mosaic.makeRoomFor(toMap(k), kImage, most_px)) << k;
      EXPECT_LE(std::max(mosaic.grid().size.width, mosaic.grid().size.height), most_px);
      EXPECT_EQ(mosaic.image().size(), mosaic.grid().size);
      const auto [image, mask] = view(k, false);
      mosaic.add(image, mask, toMap(k));
    }
    return mosaic;
  }
  /// Square metres.
  static double knownArea(const Mosaic& mosaic) {
    return cv::countNonZero(mosaic.known()) * mosaic.grid().units_per_px * mosaic.grid().units_per_px;
  }
  static cv::Mat3b plain(double grey) {
    return cv::Mat3b(kImage, cv::Vec3b::all(static_cast<uint8_t>(grey)));
  }

  const cv::Mat1b nothing_ = cv::Mat1b::zeros(kImage);
  GroundFrames frames_;
};

TEST_F(GrowingMosaic, ShowsWhatOneShowsThatWasMadeForAllFrames) {
  const Mosaic mosaic = grown(4000);
  const auto [mean, worst] = difference(mosaic, mosaic.grid(), frames_, kFrames / 2);
  EXPECT_LT(mean, 2);
  EXPECT_LT(worst, 25);
  Mosaic whole(*gridFor(frames_, kImage, 4000));
  for (int k = 0; k < kFrames; ++k) whole.add(view(k, false).first, nothing_, toMap(k));
  EXPECT_NEAR(knownArea(mosaic), knownArea(whole), 0.03 * knownArea(whole));
}

TEST_F(GrowingMosaic, IsCoarserWhereItWouldBeTooLarge) {
  const Mosaic fine = grown(4000);
  const int half = std::max(fine.grid().size.width, fine.grid().size.height) / 2 + 40;
  const Mosaic coarse = grown(half);
  const double times = coarse.grid().units_per_px / begun(0, half).grid().units_per_px;
  EXPECT_TRUE(times == 2 || times == 4) << times;
  EXPECT_LT(difference(coarse, coarse.grid(), frames_, kFrames / 2).first, 3);
  EXPECT_NEAR(knownArea(coarse), knownArea(fine), 0.05 * knownArea(fine));
}

TEST_F(GrowingMosaic, WhatWasThereBeforeItBecameCoarserCountsAsMuchAsWhatComesLater) {
  Mosaic mosaic = begun(0);
  const double fine = mosaic.grid().units_per_px;
  const int most_px = std::max(mosaic.grid().size.width, mosaic.grid().size.height);
  mosaic.add(plain(100), nothing_, toMap(0));
  ASSERT_TRUE(mosaic.makeRoomFor(toMap(kFrames - 1), kImage, most_px));
  ASSERT_EQ(mosaic.grid().units_per_px, 2 * fine);
  mosaic.add(plain(200), nothing_, toMap(0));
  const Eigen::Vector2d at =
      mosaic.grid().pixelOf((toMap(0) * Eigen::Vector3d(kWidth / 2.0, kHeight / 2.0, 1)).hnormalized());
  EXPECT_NEAR(mosaic.image()(cvRound(at.y()), cvRound(at.x()))[0], 150, 1);
}

TEST_F(GrowingMosaic, RefusesWhatIsFarOff) {
  Mosaic mosaic = begun(0);
  const MosaicGrid before = mosaic.grid();
  Eigen::Matrix3d far = Eigen::Matrix3d::Identity();
  far(0, 2) = 10'000;  // m
  EXPECT_FALSE(mosaic.makeRoomFor(far * toMap(0), kImage, 1000));
  EXPECT_EQ(mosaic.grid().size, before.size);
  EXPECT_EQ(mosaic.grid().origin, before.origin);
  EXPECT_EQ(mosaic.grid().coarsest_area, before.coarsest_area);
}

TEST_F(GrowingMosaic, OfALongFlightTheFurthestGroundIsCutOff) {
  const Eigen::Vector2d centre(kWidth / 2.0, kHeight / 2.0);
  Mosaic mosaic = begun(0, 1000);
  for (int k = 0; k < 200; ++k) {
    Eigen::Matrix3d to_map = toMap(0);
    to_map.row(0) += 0.5 * k * to_map.row(2);  // m to the right
    ASSERT_TRUE(mosaic.makeRoomFor(to_map, kImage, 1000)) << k;
    ASSERT_LE(std::max(mosaic.grid().size.width, mosaic.grid().size.height), 1000);
    ASSERT_EQ(mosaic.image().size(), mosaic.grid().size);
    mosaic.add(plain(k), nothing_, to_map);
    const Eigen::Vector2d at = mosaic.grid().pixelOf((to_map * centre.homogeneous()).eval().hnormalized());
    ASSERT_NE(mosaic.known()(cvRound(at.y()), cvRound(at.x())), 0) << k;
  }
  EXPECT_TRUE(mosaic.isCut());
  EXPECT_LE(mosaic.grid().units_per_px, 4.1 * begun(0, 1000).grid().units_per_px);
  EXPECT_FALSE(grown(1000).isCut());
}

TEST_F(GrowingMosaic, RefusesWhatWouldBeAFewPixels) {
  Mosaic mosaic = begun(0);
  Eigen::Matrix3d smaller = toMap(0);
  const Eigen::Vector2d at = (smaller * Eigen::Vector3d(kWidth / 2.0, kHeight / 2.0, 1)).hnormalized();
  for (const int axis : {0, 1})
    smaller.row(axis) = 0.05 * smaller.row(axis) + 0.95 * at(axis) * smaller.row(2);
  EXPECT_FALSE(mosaic.makeRoomFor(smaller, kImage, 1000));
  EXPECT_TRUE(mosaic.makeRoomFor(toMap(1), kImage, 1000));
}

TEST_F(GrowingMosaic, WhatIsPaintedAfterItFadedReplacesWhatWasThere) {
  Mosaic mosaic = begun(0);
  for (int i = 0; i < 300; ++i) mosaic.add(plain(100), nothing_, toMap(0));  // as of a drone that hovers
  const Eigen::Vector2d at =
      mosaic.grid().pixelOf((toMap(0) * Eigen::Vector3d(kWidth / 2.0, kHeight / 2.0, 1)).hnormalized());
  mosaic.fade();
  EXPECT_NEAR(mosaic.image()(cvRound(at.y()), cvRound(at.x()))[0], 100, 1);
  mosaic.add(plain(200), nothing_, toMap(0));
  EXPECT_GT(mosaic.image()(cvRound(at.y()), cvRound(at.x()))[0], 190);
}

TEST_F(GrowingMosaic, AMapIsLaidAnewWhereAPlaneContradictsIt) {
  const std::vector<GroundChain::Frame> piece = chain().longestPiece();
  const Eigen::Matrix3d K = camera().K();
  const Eigen::Vector2d pixel(300, 350);
  const MapReference map(piece[0], K);
  GroundChain::Frame frame = piece[12];
  EXPECT_NEAR(*map.misfit(frame, K, pixel), 1, 1e-6);
  frame.plane->distance_m *= 1.3;
  EXPECT_NEAR(*map.misfit(frame, K, pixel), 1.3, 1e-6);
  frame.plane->distance_m /= 1.3 * 1.3;
  EXPECT_NEAR(*map.misfit(frame, K, pixel), 1.3, 1e-6);
  const MapReference laid = map.relaid(frame, K, pixel);
  EXPECT_NEAR(*laid.misfit(frame, K, pixel), 1, 1e-6);
  EXPECT_LT((transfer(laid.toMap(frame), pixel) - transfer(map.toMap(frame), pixel)).norm(), 1e-6);
  const Eigen::Vector2d beside = pixel + Eigen::Vector2d(5, 0);
  const Eigen::Vector2d before = transfer(map.toMap(frame), beside) - transfer(map.toMap(frame), pixel);
  const Eigen::Vector2d after = transfer(laid.toMap(frame), beside) - transfer(laid.toMap(frame), pixel);
  EXPECT_LT((before / before.norm() - after / after.norm()).norm(), 1e-6) << "not turned";
  // A tilt by 10 degrees, too; and where the plane is not in view nothing is known.
  frame.plane = {expSO3({10 * M_PI / 180, 0, 0}) * plane(12).normal, plane(12).distance_m};
  EXPECT_GT(*map.misfit(frame, K, pixel), 1.15);
  frame.plane->normal = -frame.plane->normal;
  EXPECT_FALSE(map.misfit(frame, K, pixel));
  EXPECT_FALSE(map.misfit({1, Eigen::Matrix3d::Identity(), std::nullopt, 1}, K, pixel));
}

/// At first each pixel is a sixth as wide: what the last frames show would be too coarse for that grid.
TEST_F(GrowingMosaic, FollowsADroneThatClimbs) {
  Mosaic mosaic = begun(0);
  const Eigen::Matrix3d to_map0 = toMap(0) * toPixels(0);  // from the ground
  const Eigen::Vector2d centre(kWidth / 2.0, kHeight / 2.0);
  for (double height = 10; height <= 60; height += 2) {
    const Eigen::Matrix3d to_map = to_map0 * toPixels(rotation(0), {-1, -8, height}).inverse();
    ASSERT_TRUE(mosaic.makeRoomFor(to_map, kImage, 1000)) << height;
    mosaic.add(plain(100), nothing_, to_map);
    const Eigen::Vector2d at = mosaic.grid().pixelOf((to_map * centre.homogeneous()).eval().hnormalized());
    EXPECT_NE(mosaic.known()(cvRound(at.y()), cvRound(at.x())), 0) << height;
  }
  // A glance at the horizon does not make all coarser: it shows ground at its lower edge, very flat.
  const double coarsest_area = mosaic.grid().coarsest_area;
  Eigen::Matrix3d north;
  north << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  const Eigen::Matrix3d flat =
      to_map0 * toPixels(north * expSO3({15 * M_PI / 180, 0, 0}), {-1, -8, 60}).inverse();
  mosaic.makeRoomFor(flat, kImage, 1000);
  EXPECT_EQ(mosaic.grid().coarsest_area, coarsest_area);
}

TEST(GroundChain, GoesOnWithoutWhatWasErased) {
  GroundChain chain;
  GroundChain whole;
  Eigen::Matrix3d step = Eigen::Matrix3d::Identity();
  step(0, 2) = 3;
  chain.addStep(1, 2, step);
  for (int64_t k = 10; k < 20; ++k) {
    chain.addStep(k, k + 1, step);
    whole.addStep(k, k + 1, step);
    chain.setPlane(k, {Eigen::Vector3d::UnitZ(), 1});
    chain.eraseBefore(k - 2);
  }
  EXPECT_EQ(chain.pieces(), 2U);
  EXPECT_EQ(chain.longestPiece().size(), 4U);
  EXPECT_EQ(chain.frame(16), nullptr);
  ASSERT_NE(chain.frame(20), nullptr);
  EXPECT_EQ(chain.frame(20)->H, whole.longestPiece().back().H);
  EXPECT_EQ(chain.lastFrame(), chain.frame(20));
  EXPECT_EQ(chain.lastWithPlane(), chain.frame(19));
  chain.eraseBefore(1000);
  chain.addStep(20, 21, step);
  EXPECT_EQ(chain.pieces(), 2U) << "the newest frame stays";
}

}  // namespace
}  // namespace redbee::test
