// The live mosaic is the texture that was flown over, is bounded, and costs nothing while nobody looks.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "processes/serve/station.hpp"
#include "tests/serve/watched_ground.hpp"

namespace redbee::test {
namespace {

using LiveMosaicTest = WatchedGround;

TEST_F(LiveMosaicTest, IsTheGroundWithoutTheMoverAndItsTrack) {
  step(0);
  EXPECT_TRUE(ask().head.is_null());
  fly(1, 60);
  const Bundle first = ask();
  ASSERT_FALSE(first.head.is_null());
  fly(60, 120);
  const Bundle second = ask(first.head["sequence"]);
  ASSERT_FALSE(second.head.is_null());
  EXPECT_GT(second.image.cols, first.image.cols) << "it grows";
  EXPECT_EQ(second.head["unit"], "m");
  EXPECT_NEAR(second.head["units_per_px"], kHeight_m / 500, 1e-9);
  ASSERT_EQ(second.head["tracks"].size(), 1U);

  // Where the texture is in the mosaic: what both were made of is the same but for compression.
  cv::Mat1b grey;
  cv::cvtColor(second.image, grey, cv::COLOR_BGR2GRAY);
  const auto [fit, found] = find(60, 1, second.image);
  EXPECT_GT(fit, 0.98);
  const cv::Point offset = found.tl() - cv::Point(kStep_px * 60 + 400, 300);
  // The track is the middle of the lower edge, frame by frame, on the ground.
  const std::vector<cv::Point> track = pointsOf(second.head["tracks"][0]);
  for (const int k : {30, 60, 90}) {
    const cv::Rect mover = moverIn(k);
    const cv::Point foot(kStep_px * k + mover.x + mover.width / 2, mover.y + mover.height - 1);
    EXPECT_LT(distanceTo(track, foot + offset), 3) << k;
  }
  EXPECT_EQ(second.head["tracks"][0]["id"], 3);
  const auto& newest_label = second.head["tracks"][0]["labels"].back();
  EXPECT_EQ(newest_label[2].get<std::string>().substr(0, 3), "3: ");
  EXPECT_EQ(cv::Point(newest_label[0], newest_label[1]), track.back());
  EXPECT_TRUE(second.head["notes"].empty());
  // Above the track, where the mover went, it is the ground.
  for (const int k : {30, 60, 90}) {
    const cv::Rect inside(kStep_px * k + moverIn(k).x + kMargin, moverIn(k).y, 20, 25);
    EXPECT_LT(cv::norm(grey(inside + offset), texture_(inside), cv::NORM_L1) / inside.area(), 8) << k;
  }
}

TEST_F(LiveMosaicTest, KeepsNothingWhileNobodyAsks) {
  step(0);
  FrameView view = frame(1);
  step(1);
  mosaic().onFrame(view, now_);
  EXPECT_EQ(view.image.use_count(), 1);
  ask();
  step(2);
  FrameView next = frame(2);
  mosaic().onFrame(next, now_);
  EXPECT_EQ(next.image.use_count(), 2);
  now_ += LiveMosaic::kAskedFor;
  step(3);
  FrameView later = frame(30);
  mosaic().onFrame(later, now_);
  EXPECT_EQ(later.image.use_count(), 1);
}

TEST_F(LiveMosaicTest, AFewImagesWaitForWhoAsksAndNoMore) {
  step(0);
  ask();
  std::vector<FrameView> views;
  for (int k = 1; k < 200; ++k) {
    step(k);
    views.push_back(frame(k));
    mosaic().onFrame(views.back(), now_);
  }
  size_t kept = 0;
  for (const FrameView& view : views) kept += view.image.use_count() > 1 ? 1 : 0;
  EXPECT_EQ(kept, LiveMosaic::kMostImages);
  EXPECT_EQ(ask().head["frames"], LiveMosaic::kMostImages);
}

TEST_F(LiveMosaicTest, BeginsAnewWhereNoHomographyLeadsOn) {
  step(0);
  ask();
  fly(1, 60);
  const Bundle before = ask();
  step(60, true, fused_homography_t::NONE);
  fly(61, 70);
  const Bundle after = ask(before.head["sequence"]);
  ASSERT_FALSE(after.head.is_null());
  EXPECT_LT(after.image.cols, before.image.cols);
  EXPECT_LT(after.head["frames"], before.head["frames"]);
  EXPECT_TRUE(says(after, "no homography led on"));
}

TEST_F(LiveMosaicTest, IsInPixelsUntilAPlaneIsKnownAndThenInMetres) {
  step(0, false);
  ask();
  fly(1, 20, false);
  const Bundle pixels = ask();
  EXPECT_EQ(pixels.head["unit"], "px");
  fly(20, 40);
  EXPECT_EQ(ask(pixels.head["sequence"]).head["unit"], "m");
}

TEST_F(LiveMosaicTest, WithoutAMaskNothingIsPainted) {
  step(0);
  ask();
  step(1);
  FrameView view = frame(1);
  view.mask.clear();
  mosaic().onFrame(view, now_);
  EXPECT_TRUE(ask().head.is_null());
}

TEST_F(LiveMosaicTest, IsGoneWhenNobodyLooksAtThePage) {
  step(0);
  ask();
  fly(1, 60);
  ASSERT_FALSE(ask().head.is_null());
  mosaic().release();
  EXPECT_TRUE(ask().head.is_null());
  fly(60, 80);
  EXPECT_LE(ask().image.cols, kWidth + 2 * MosaicPainting::kMost_px / 16 + kStep_px * 20);
}

TEST_F(LiveMosaicTest, TheStationGivesTheNewest) {
  Live live;
  Archive archive(configuration_, {});
  Station station(Access(*listenAddressOf("127.0.0.1:1"), "", false), archive, live, supervisedStack());
  const auto get = [&](const std::string& after) {
    return station.answer({"GET", "/api/mosaic", {{"after", after}}, {{"host", "localhost"}}});
  };
  EXPECT_EQ(get("0").status, 204);
  station.showMosaic(mosaic());
  EXPECT_EQ(get("-1").status, 400);
  EXPECT_EQ(get("0").status, 204);
  now_ = std::chrono::steady_clock::now();
  step(0);
  fly(1, 20);
  const WebResponse response = get("0");
  EXPECT_EQ(response.status, 200);
  EXPECT_NE(response.body.find("\"sequence\""), std::string::npos);
}

}  // namespace
}  // namespace redbee::test
