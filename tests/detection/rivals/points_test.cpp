// What the rivals share: registration, windows of tracks, ego-motion, clusters of flow.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>
#include <set>

#include "redbee/detection/rivals/datmo.hpp"
#include "redbee/detection/rivals/ego_motion.hpp"
#include "redbee/detection/rivals/flow_clusters.hpp"
#include "redbee/detection/rivals/flow_residual.hpp"
#include "redbee/detection/rivals/graded_score.hpp"
#include "redbee/detection/rivals/image_history.hpp"
#include "redbee/detection/rivals/registration.hpp"
#include "redbee/detection/rivals/trajectory_window.hpp"
#include "tests/detection/rivals/scene.hpp"

namespace redbee::test {
namespace {

const std::vector<SceneFrame>& scene() {
  static const std::vector<SceneFrame> frames = makeScene({});
  return frames;
}

Eigen::Matrix3d trueStep(size_t k) { return planeHomography(scene()[k].input.K, *scene()[k].input.motion); }

TEST(Registrar, FindsTheGroundsHomography) {
  Registrar registrar;
  EXPECT_FALSE(registrar.advance(scene()[0].input.grey));
  for (size_t k = 1; k < 5; ++k) {
    const auto found = registrar.advance(scene()[k].input.grey);
    ASSERT_TRUE(found);
    Eigen::Matrix3d H;
    cv::cv2eigen(*found, H);
    EXPECT_LT(meanTransferError(H, trueStep(k), 480, 360), 0.15);
  }
}

TEST(Registrar, UnrelatedImagesAreNotRegistered) {
  Registrar registrar;
  registrar.advance(scene()[0].input.grey);
  cv::Mat noise(scene()[0].input.grey.size(), CV_8U);
  cv::RNG(5).fill(noise, cv::RNG::UNIFORM, 0, 255);
  EXPECT_FALSE(registrar.advance(noise));
}

TEST(Registrar, ATenthOfTheImageIsEnough) {
  GridTracks tracks;
  std::mt19937 random(7);
  std::uniform_real_distribution<float> anywhere(-12, 12);
  for (const cv::Point2f& point : gridPoints({640, 480}, {32, 24})) {
    const Eigen::Vector2d moved = transfer(trueStep(1), Eigen::Vector2d(point.x, point.y));
    const bool follows = tracks.previous.size() % 10 == 0;
    tracks.previous.push_back(point);
    tracks.current.emplace_back(static_cast<float>(moved.x()) + (follows ? 0 : anywhere(random)),
                                static_cast<float>(moved.y()) + (follows ? 0 : anywhere(random)));
  }
  tracks.sampled = tracks.previous.size();
  const auto found = registerTracks(tracks);
  ASSERT_TRUE(found);
  Eigen::Matrix3d H;
  cv::cv2eigen(*found, H);
  EXPECT_LT(meanTransferError(H, trueStep(1), 640, 480), 1);
}

TEST(ImageHistory, TheOldestAnswersToTheNewest) {
  const auto shift = [](double x) { return cv::Matx33d(1, 0, x, 0, 1, 0, 0, 0, 1); };
  const auto image = [](int grey) { return cv::Mat(2, 2, CV_8U, cv::Scalar(grey)); };
  ImageHistory history(2);
  EXPECT_TRUE(history.empty());
  history.push(image(1));
  history.carry(shift(3));
  EXPECT_EQ(history.oldest().at<uint8_t>(0, 0), 1);
  EXPECT_EQ(history.oldestToNewest()(0, 2), 3);
  history.push(image(2));
  history.carry(shift(4));
  EXPECT_EQ(history.oldest().at<uint8_t>(0, 0), 1);
  EXPECT_EQ(history.oldestToNewest()(0, 2), 7);
  history.push(image(3));
  history.carry(shift(5));
  EXPECT_EQ(history.oldest().at<uint8_t>(0, 0), 2) << "two are kept";
  EXPECT_EQ(history.oldestToNewest()(0, 2), 9);
}

TEST(TrajectoryWindow, TracksFollowTheGround) {
  TrajectoryWindowParameters parameters;
  parameters.frames = 5;
  parameters.least_frames = 5;
  TrajectoryWindow window(parameters);
  for (size_t k = 0; k < 4; ++k) {
    EXPECT_TRUE(window.advance(scene()[k].input.grey));
    EXPECT_EQ(window.trajectories().cols(), 0) << "the window fills";
  }
  window.advance(scene()[4].input.grey);
  const Eigen::MatrixXd X = window.trajectories();
  ASSERT_EQ(X.rows(), 10);
  ASSERT_GT(X.cols(), 150);
  int right = 0;
  int on_ground = 0;
  for (Eigen::Index i = 0; i < X.cols(); ++i) {
    Eigen::Vector2d at = X.col(i).head<2>();
    const cv::Mat& truth = scene()[0].truth;
    if (truth.at<uint8_t>(static_cast<int>(at.y()), static_cast<int>(at.x())) != 0) continue;
    ++on_ground;
    for (size_t k = 1; k < 5; ++k) at = transfer(trueStep(k), at);
    right += (at - X.col(i).tail<2>()).norm() < 0.5 ? 1 : 0;
  }
  EXPECT_GT(right, 0.95 * on_ground);
}

TEST(TrajectoryWindow, ACellHoldsOneTrack) {
  TrajectoryWindow window({});
  for (const SceneFrame& frame : scene()) window.advance(frame.input.grey);
  const Eigen::MatrixXd X = window.trajectories();
  std::set<std::pair<int, int>> cells;
  for (Eigen::Index i = 0; i < X.cols(); ++i) {
    const Eigen::Vector2d last = X.col(i).tail<2>();
    cells.emplace(static_cast<int>(last.x()) / window.parameters().grid_px,
                  static_cast<int>(last.y()) / window.parameters().grid_px);
  }
  EXPECT_EQ(static_cast<Eigen::Index>(cells.size()), X.cols());
}

class Ego : public ::testing::Test {
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
    for (const double share : {1.0, 0.7, 0.4, 0.2})
      EXPECT_LT(offSegment(*segment, seen(p, share * groundDepth(p))).norm(), 1e-3);
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
  EXPECT_NEAR(offSegment(*segment, moved(2 * Eigen::Vector2d(-along.y(), along.x()))).norm(), 2, 1e-3);
  EXPECT_NEAR(offSegment(*segment, moved(-1.5 * along)).norm(), 1.5, 1e-3) << "below the ground: wrong size";
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
    EXPECT_LT(offSegment(*segment, tracks.current[i]).norm(), 0.1);
  }
  EXPECT_FALSE(EgoMotion::fromTracks({}, K_, 4));
}

std::vector<StrayPoint> twoGroups() {
  std::vector<StrayPoint> points;
  for (int i = 0; i < 5; ++i) {
    const auto x = static_cast<float>(10 * i);
    points.push_back({{100 + x, 100}, {3, 0}, 2});
    points.push_back({{100 + x, 110}, {-3, 0}, 6});
  }
  points.push_back({{300, 200}, {5, 5}, 10});
  return points;
}

TEST(FlowClusters, AreOfOnePlaceAndOneMotion) {
  const std::vector<FlowCluster> clusters = clusterFlow(twoGroups(), {});
  ASSERT_EQ(clusters.size(), 2u) << "neighbours that move apart are two, a lonely point is none";
  for (const FlowCluster& cluster : clusters) {
    EXPECT_EQ(cluster.points.size(), 5u);
    EXPECT_NEAR(std::abs(cluster.motion.x), 3, 1e-5);
    EXPECT_NEAR(cluster.centre.x, 120, 1e-4);
  }
  EXPECT_TRUE(clusterFlow({}, {}).empty());
}

TEST(FlowClusters, ScoresAreThoseOfTheStrictestDecision) {
  const cv::Mat map = paintClusters({400, 300}, twoGroups(), {});
  EXPECT_EQ(map.at<uint8_t>(98, 120), gradedScore(2.0F));
  EXPECT_EQ(map.at<uint8_t>(112, 120), gradedScore(4 * std::sqrt(2.0F))) << "the last level below 6";
  EXPECT_EQ(map.at<uint8_t>(200, 300), 0);
}

TEST(GroupFilter, LastingGroupsAreConfirmed) {
  GroupFilter filter;
  const auto groupAt = [](float x) {
    FlowCluster cluster;
    cluster.centre = {x, 50};
    return cluster;
  };
  // The view moves by 20 px a frame, further than any gate; the group moves with it and 4 px besides.
  const cv::Matx33d H(1, 0, 20, 0, 1, 0, 0, 0, 1);
  for (int k = 0; k < 6; ++k) {
    const auto lasting = filter.lasting({groupAt(static_cast<float>(50 + 24 * k))}, H);
    EXPECT_EQ(lasting.size(), k + 1 < GroupFilter::kConfirmFrames ? 0u : 1u) << k;
  }
  EXPECT_TRUE(filter.lasting({groupAt(400)}, H).empty()) << "elsewhere it is another";
}

TEST(FlowResidual, IsZeroWhereTheHomographyExplainsTheFlow) {
  const cv::Matx33d H(1.01, 0.002, 3, -0.003, 0.99, -2, 1e-6, 2e-6, 1);
  const cv::Matx33d back = H.inv();
  cv::Mat flow(60, 80, CV_32FC2);
  for (int y = 0; y < flow.rows; ++y) {
    for (int x = 0; x < flow.cols; ++x) {
      const cv::Vec3d p = back * cv::Vec3d(x, y, 1);
      flow.at<cv::Vec2f>(y, x) = {static_cast<float>(p[0] / p[2] - x), static_cast<float>(p[1] / p[2] - y)};
    }
  }
  flow.at<cv::Vec2f>(30, 40) += cv::Vec2f(3, 4);
  const cv::Mat remains = flowAgainst(flow, H);
  EXPECT_NEAR(remains.at<float>(30, 40), 5, 1e-4);
  EXPECT_NEAR(remains.at<float>(20, 20), 0, 1e-4);
}

}  // namespace
}  // namespace redbee::test
