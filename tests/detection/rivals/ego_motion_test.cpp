#include "redbee/detection/rivals/ego_motion.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "redbee/geometry/so3.hpp"

namespace redbee::test {
namespace {

class Ego : public testing::Test {
 protected:
  Ego() {
    K_ << 500, 0, 320, 0, 500, 240, 0, 0, 1;
    motion_.R_ba = expSO3(Eigen::Vector3d(0.01, -0.02, 0.005));
    motion_.t_ba = {0.05, 0.02, -0.1};
    motion_.m_a = Eigen::Vector3d(0, 0.8, 0.6);
    motion_.h_a = 4;
  }
  /// Current pixel of the static point at this depth along a previous pixel's ray.
  cv::Point2f seen(const cv::Point2f& previous, double depth) const {
    const Eigen::Vector3d X = depth * (K_.inverse() * Eigen::Vector3d(previous.x, previous.y, 1));
    const Eigen::Vector3d x = K_ * (motion_.R_ba * X + motion_.t_ba);
    return {static_cast<float>(x.x() / x.z()), static_cast<float>(x.y() / x.z())};
  }
  double groundDepth(const cv::Point2f& p) const {
    return motion_.h_a / motion_.m_a.dot(K_.inverse() * Eigen::Vector3d(p.x, p.y, 1));
  }
  Eigen::Matrix3d K_;
  PlaneMotion motion_;
};

TEST_F(Ego, StaticPointsLieOnTheirSegments) {
  const EgoMotion ego(motion_, K_, 0.15, 0.0);
  for (const cv::Point2f& p : {cv::Point2f(100, 300), cv::Point2f(400, 400), cv::Point2f(600, 200)}) {
    const auto segment = ego.segmentOf(p);
    ASSERT_TRUE(segment);
    for (const double fraction : {1.0, 0.7, 0.4, 0.2})
      EXPECT_LT(segmentResidual(*segment, seen(p, fraction * groundDepth(p))).norm(), 1e-3);
  }
}

TEST_F(Ego, WhatMovesOffTheSegmentIsMeasured) {
  const EgoMotion ego(motion_, K_, 0.15, 0.0);
  const cv::Point2f p(400, 400);
  const auto segment = ego.segmentOf(p);
  ASSERT_TRUE(segment);
  const Eigen::Vector2d along = (segment->nearest - segment->farthest).normalized();
  const cv::Point2f on_ground = seen(p, groundDepth(p));
  const auto moved = [&](const Eigen::Vector2d& by) {
    return on_ground + cv::Point2f(static_cast<float>(by.x()), static_cast<float>(by.y()));
  };
  EXPECT_NEAR(segmentResidual(*segment, moved(2 * Eigen::Vector2d(-along.y(), along.x()))).norm(), 2, 1e-3);
  EXPECT_NEAR(segmentResidual(*segment, moved(-1.5 * along)).norm(), 1.5, 1e-3)
      << "below the ground: wrong size";
}

TEST_F(Ego, ComesFromTracksWhereThereIsNoImu) {
  GridTracks tracks;
  for (int i = 0; i < 200; ++i) {
    const cv::Point2f p(static_cast<float>(20 + (i * 97) % 600), static_cast<float>(250 + (i * 53) % 220));
    const double depth = groundDepth(p) * (i % 4 == 0 ? 0.6 : 1.0);
    tracks.previous.push_back(p);
    tracks.current.push_back(seen(p, depth));
  }
  tracks.sampled = tracks.previous.size();
  const auto ego = EgoMotion::fromTracks(tracks, K_, 4);
  ASSERT_TRUE(ego);
  for (size_t i = 0; i < tracks.previous.size(); ++i) {
    const auto segment = ego->segmentOf(tracks.previous[i]);
    ASSERT_TRUE(segment);
    EXPECT_LT(segmentResidual(*segment, tracks.current[i]).norm(), 0.1);
  }
  EXPECT_FALSE(EgoMotion::fromTracks({}, K_, 4));
}

}  // namespace
}  // namespace redbee::test
