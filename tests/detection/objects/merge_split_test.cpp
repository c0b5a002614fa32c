// Objects that pass each other, and bodies in several components.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "redbee/imaging/box_overlap.hpp"
#include "tests/support/tracked_objects.hpp"

namespace redbee::test {
namespace {

/// The identity of the seen track whose box overlaps this one most; 0: none by half.
int identityAt(const std::vector<Detection>& tracks, const cv::Rect& box) {
  for (const Detection& track : tracks)
    if (track.seen && intersectionOverUnion(track.box, box) > 0.5) return track.id;
  return 0;
}

TEST(MergeSplit, ObjectsThatPassKeepTheirIdentities) {
  TrackerFlight flight(atOnce());
  int left = 0, right = 0;
  for (int k = 0; k < 40; ++k) {
    const cv::Rect a(100 + 6 * k, 200, 20, 30), b(340 - 6 * k, 220, 20, 30);  // one component while they pass
    const auto tracks = flight.step({{a}, {b}});
    if (k == 8) {
      left = identityAt(tracks, a);
      right = identityAt(tracks, b);
      ASSERT_NE(left, right);
    }
    EXPECT_LE(tracks.size(), 2U) << "frame " << k;
    if (k < 8 || (a & b).area() > 0) continue;
    EXPECT_EQ(identityAt(tracks, a), left) << "frame " << k;
    EXPECT_EQ(identityAt(tracks, b), right) << "frame " << k;
  }
}

TEST(MergeSplit, ThreeInARowThatTouchForAMomentStayThree) {
  TrackerFlight flight(atOnce());
  for (int k = 0; k < 48; ++k) {
    const int gap = std::clamp(std::abs(k - 32) - 6, 0, 6);  // px between them
    Regions people;
    for (int i = 0; i < 3; ++i) people.push_back({{100 + 2 * k + i * (16 + gap), 200, 16, 40}});
    const auto tracks = flight.step(people);
    ASSERT_EQ(tracks.size(), 3U) << "frame " << k;
    for (const Region& person : people) {
      EXPECT_NE(identityAt(tracks, person.box), 0) << "frame " << k;
    }
    for (const Detection& track : tracks) EXPECT_LE(track.id, 3);
  }
}

TEST(MergeSplit, ABodyInTwoHalvesStaysOneTrack) {
  TrackerFlight flight(atOnce());
  for (int k = 0; k < 48; ++k) {
    const cv::Rect body(100 + 2 * k, 200, 20, 50);
    const bool in_halves = k > 12 && k < 36;
    const cv::Rect upper(body.x, body.y, 20, 22), lower(body.x, body.y + 28, 20, 22);
    const auto tracks = flight.step(in_halves ? Regions{{upper}, {lower}} : Regions{{body}});
    ASSERT_EQ(tracks.size(), 1U) << "frame " << k;
    EXPECT_EQ(tracks[0].id, 1);
    EXPECT_GT(intersectionOverUnion(tracks[0].box, body), 0.8) << "frame " << k;
  }
}

TEST(MergeSplit, AnIdentityDoesNotJumpToANeighbour) {
  TrackerFlight flight(atOnce());
  for (int k = 0; k < 24; ++k) flight.step({{{100, 200, 16, 40}}, {{124, 200, 16, 40}}});
  // One is no longer found; the other stands where it stood.
  for (int k = 0; k < 12; ++k) {
    const auto tracks = flight.step({{{124, 200, 16, 40}}});
    ASSERT_EQ(tracks.size(), 2U);
    EXPECT_EQ(tracks[0].seen, false);
    EXPECT_EQ(tracks[1].seen, true);
    EXPECT_EQ(identityAt(tracks, {124, 200, 16, 40}), tracks[1].id);
  }
}

TEST(MergeSplit, TheLeastCostDecidesNotTheNearestPair) {
  // Two side by side move right by half their distance: the nearest pair would be old right, new left.
  TrackerFlight flight(atOnce());
  int left = 0, right = 0;
  for (int k = 0; k < 24; ++k) {
    const cv::Rect a(100 + 2 * k, 200, 20, 30), b(126 + 2 * k, 200, 20, 30);
    const auto tracks = flight.step({{a}, {b}});
    if (k == 12) left = identityAt(tracks, a), right = identityAt(tracks, b);
  }
  const cv::Rect a(146 + 12, 200, 20, 30), b(172 + 12, 200, 20, 30);
  const auto tracks = flight.step({{a}, {b}});
  ASSERT_EQ(tracks.size(), 2U);
  EXPECT_EQ(tracks[0].id, left);
  EXPECT_LT(tracks[0].box.x, tracks[1].box.x);
  EXPECT_EQ(tracks[1].id, right);
}

}  // namespace
}  // namespace redbee::test
