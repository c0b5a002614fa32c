#include "redbee/simulation/tracks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "redbee/geometry/homography.hpp"

namespace redbee::simulation {
namespace {

const Eigen::Matrix3d kGround = (Eigen::Matrix3d() << 1, 0.01, 4, -0.01, 1.01, -3, 1e-5, 2e-5, 1).finished();
const Eigen::Matrix3d kOther = (Eigen::Matrix3d() << 1, 0, -9, 0, 1, 2, 0, 0, 1).finished();

long countOf(const SimulatedTracks& tracks, TrackOrigin origin) {
  return std::count(tracks.origin.begin(), tracks.origin.end(), origin);
}

TEST(Tracks, EachFollowsThePlaneItBelongsTo) {
  const SimulatedTracks tracks = simulateTracks(kGround, kOther, 0.25, 0, 0.4, {}, 5);
  ASSERT_EQ(tracks.before.size(), 1200U);
  EXPECT_EQ(countOf(tracks, TrackOrigin::kOutlier), 480);
  for (size_t i = 0; i < tracks.before.size(); ++i) {
    const double from_ground = (tracks.after[i] - transfer(kGround, tracks.before[i])).norm();
    const double from_other = (tracks.after[i] - transfer(kOther, tracks.before[i])).norm();
    switch (tracks.origin[i]) {
      case TrackOrigin::kGround:
        EXPECT_LT(from_ground, 1e-9);
        break;
      case TrackOrigin::kOther:
        EXPECT_LT(from_other, 1e-9);
        EXPECT_GE(tracks.before[i].x(), 480) << "the last quarter of the columns";
        break;
      case TrackOrigin::kOutlier:
        EXPECT_GE(std::min(from_ground, from_other), 5);
    }
  }
}

TEST(Tracks, NoiseHasTheSizeAskedFor) {
  const SimulatedTracks tracks = simulateTracks(kGround, kOther, 0, 0.3, 0, {}, 6);
  double squares = 0;
  for (size_t i = 0; i < tracks.before.size(); ++i) {
    squares += (tracks.after[i] - transfer(kGround, tracks.before[i])).squaredNorm();
  }
  EXPECT_NEAR(std::sqrt(squares / 2400), 0.3, 0.02);
}

TEST(Tracks, TheSeedDecides) {
  const auto after = [](unsigned seed) {
    return simulateTracks(kGround, kOther, 0.2, 0.3, 0.2, {}, seed).after;
  };
  EXPECT_EQ(after(1), after(1));
  EXPECT_NE(after(1), after(2));
}

}  // namespace
}  // namespace redbee::simulation
