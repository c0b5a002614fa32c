// The live mosaic in the course of a flight: what is newest is seen, and what it cannot show is said.
#include "tests/serve/watched_ground.hpp"

namespace redbee::test {
namespace {

using LongMosaic = WatchedGround;

TEST_F(LongMosaic, OfALongFlightTheNewestGroundIsSeenInBoundedSpace) {
  step(0);
  ask();
  for (int k = 1; k < 800; k += 20) {
    fly(k, k + 20);
    const Bundle bundle = ask();
    ASSERT_LE(std::max(bundle.image.cols, bundle.image.rows), MosaicPainting::kMost_px);
    // A quarter of the longest side is what a frame has at least.
    ASSERT_LT(bundle.head["units_per_px"], 2.1 * kHeight_m / 500) << k;
  }
  const Bundle bundle = ask();
  EXPECT_TRUE(says(bundle, "has left it"));
  const auto [fit, found] = find(797, 0.5, bundle.image);  // painted every fifth: 797 is shown by 800 as well
  EXPECT_GT(fit, 0.95);
  EXPECT_GT(found.br().x, bundle.image.cols - MosaicPainting::kMost_px / 8) << "at the right edge";
  for (const cv::Point& point : pointsOf(bundle.head["tracks"][0])) EXPECT_GE(point.x, 0);
}

TEST_F(LongMosaic, AMapThatThePlaneContradictsIsLaidAnewWhereTheFlightIs) {
  step(0);
  ask();
  for (int k = 1; k < 60; k += 20) {  // a few images wait for who asks
    fly(k, k + 20);
    ask();
  }
  height_m_ = 1.4 * kHeight_m;  // what was 10 m is 14 m: the same pixels are more metres
  fly(61, 71);
  const Bundle doubted = ask();
  EXPECT_TRUE(doubted.head["notes"].empty()) << "one second may be a fault of the plane";
  fly(71, 100);
  const Bundle laid = ask();
  EXPECT_TRUE(says(laid, "did not fit"));
  EXPECT_EQ(laid.head["units_per_px"], doubted.head["units_per_px"]);
  EXPECT_GT(laid.head["frames"], doubted.head["frames"]) << "it goes on";
  EXPECT_GT(find(95, 1.4, laid.image).first, 0.9);
  EXPECT_GT(find(-98, 1, laid.image).first, 0.8) << "what was there stays, where nothing newer lies over it";
}

TEST_F(LongMosaic, OnePlaneAfterNoneForSecondsIsNoContradictionOfASecond) {
  step(0);
  ask();
  fly(1, 20);
  fly(20, 60, false);
  height_m_ = 1.4 * kHeight_m;
  fly(60, 61);
  EXPECT_TRUE(ask().head["notes"].empty());
}

TEST_F(LongMosaic, FramesThatAreRefusedAddNothingToTheTracks) {
  step(0);
  ask();
  fly(1, 40);
  leap(40, 30'000);
  fly(41, 60);
  ask();
  leap(60, -30'000);
  fly(61, 90);
  const Bundle bundle = ask();
  EXPECT_GT(find(80, 1, bundle.image).first, 0.95) << "goes on where it was";
  ASSERT_EQ(bundle.head["tracks"].size(), 1U);
  for (const cv::Point& point : pointsOf(bundle.head["tracks"][0]))
    EXPECT_TRUE(cv::Rect({0, 0}, bundle.image.size()).contains(point)) << point;
}

TEST_F(LongMosaic, BeginsAnewWhereTheFlightIsTooFarFromIt) {
  step(0);
  ask();
  fly(1, 40);
  leap(40, 30'000);
  for (int k = 41; k < 161; k += 20) {
    fly(k, k + 20);
    ask();
  }
  const Bundle bundle = ask();
  EXPECT_TRUE(says(bundle, "too far"));
  EXPECT_GT(find(155, 1, bundle.image).first, 0.95);
}

}  // namespace
}  // namespace redbee::test
