// The Kalman filter over a box: against motion that is computed here, and its own covariance.
#include "redbee/detection/objects/box_filter.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <random>

#include "redbee/geometry/chi_square.hpp"
#include "redbee/geometry/homography.hpp"

namespace redbee {
namespace {

const Eigen::Matrix3d kStill = Eigen::Matrix3d::Identity();
constexpr double kSteady_s = 1e6;  // the velocity lasts

BoxMeasurement measured(const cv::Rect2d& box, double sigma_px = 1) {
  BoxMeasurement measurement;
  measurement.edges_px << box.x, box.y, box.x + box.width, box.y + box.height;
  measurement.variance_px2.setConstant(sigma_px * sigma_px);
  return measurement;
}

/// A drone that looks down obliquely, sinks, advances and turns.
Eigen::Matrix3d descent() {
  Eigen::Matrix3d K;
  K << 500, 0, 320, 0, 500, 240, 0, 0, 1;
  PlaneMotion motion;
  motion.R_ba = Eigen::AngleAxisd(0.02, Eigen::Vector3d(0.2, 0.5, 1).normalized()).toRotationMatrix();
  motion.t_ba = {0.1, -0.2, -0.5};
  motion.m_a = Eigen::Vector3d(0, 0.8, 0.6);
  motion.h_a = 10;
  return planeHomography(K, motion);
}

Eigen::Vector2d centreOf(const cv::Rect2d& box) { return {box.x + box.width / 2, box.y + box.height / 2}; }

TEST(BoxFilter, ABoxAtRestMovesWithTheGround) {
  const Eigen::Matrix3d ground = descent();
  const cv::Rect2d box(400, 260, 2, 2);  // small, so that it maps to a parallelogram
  BoxFilter filter(measured(box));
  filter.predict(ground, 0.04, kSteady_s);
  const Eigen::Vector2d centre = transfer(ground, centreOf(box));
  EXPECT_NEAR((centreOf(filter.box()) - centre).norm(), 0, 1e-9);
  std::array<Eigen::Vector2d, 4> corners;
  for (int i = 0; i < 4; ++i)
    corners[static_cast<size_t>(i)] = transfer(ground, {400 + 2 * (i == 1 || i == 2), 260 + 2 * (i >= 2)});
  double area = 0;
  for (size_t i = 0; i < 4; ++i) {
    const Eigen::Vector2d& a = corners[i];
    const Eigen::Vector2d& b = corners[(i + 1) % 4];
    area += 0.5 * (a.x() * b.y() - a.y() * b.x());
  }
  EXPECT_NEAR(filter.box().area() / area, 1, 1e-3);
}

TEST(BoxFilter, TheCovarianceIsThatOfDisturbedBoxes) {
  const Eigen::Matrix3d ground = descent();
  const cv::Rect2d box(400, 260, 30, 60);
  const double sigma_px = 0.5;
  const auto predicted = [&](const Eigen::Vector4d& disturbance) {
    BoxMeasurement measurement = measured(box, sigma_px);
    measurement.edges_px += disturbance;
    BoxFilter filter(measurement);
    filter.predict(ground, 0, kSteady_s);
    return filter;
  };
  Eigen::Matrix4d J;
  for (int edge = 0; edge < 4; ++edge) {
    const Eigen::Vector4d step = 0.01 * Eigen::Vector4d::Unit(edge);
    J.col(edge) = (predicted(step).state() - predicted(-step).state()).head<4>() / 0.02;
  }
  const Eigen::Matrix4d expected = sigma_px * sigma_px * J * J.transpose();
  const Eigen::Matrix4d covariance = predicted(Eigen::Vector4d::Zero()).covariance().topLeftCorner<4, 4>();
  EXPECT_NEAR((covariance - expected).norm() / expected.norm(), 0, 1e-5);
}

TEST(BoxFilter, LearnsAConstantVelocity) {
  BoxFilter filter(measured({100, 200, 20, 30}));
  for (int k = 1; k <= 24; ++k) {
    filter.predict(kStill, 1.0 / 24, kSteady_s);
    filter.update(measured({100 + 2.5 * k, 200 - 1.0 * k, 20, 30}));
  }
  EXPECT_NEAR(filter.velocity().x(), 60, 0.5);
  EXPECT_NEAR(filter.velocity().y(), -24, 0.5);
}

TEST(BoxFilter, TheVelocityTurnsAndGrowsWithTheImage) {
  BoxFilter filter(measured({300, 200, 20, 30}));
  for (int k = 1; k <= 48; ++k) {
    filter.predict(kStill, 1.0 / 24, kSteady_s);
    filter.update(measured({300 + 2.0 * k, 200, 20, 30}));
  }
  Eigen::Matrix3d turn = kStill;  // a quarter turn, twice as large
  turn.topLeftCorner<2, 2>() << 0, -2, 2, 0;
  const Eigen::Vector2d before = filter.velocity();
  filter.predict(turn, 1.0 / 24, kSteady_s);
  EXPECT_NEAR(filter.velocity().x(), -2 * before.y(), 1e-3);
  EXPECT_NEAR(filter.velocity().y(), 2 * before.x(), 1e-3);
  EXPECT_NEAR(filter.box().height, 60, 1);
}

TEST(BoxFilter, TenAndThirtyHertzPredictAlike) {
  const auto predicted = [](int steps) {
    BoxFilter filter(measured({100, 200, 20, 30}));
    for (int k = 0; k < steps; ++k) filter.predict(kStill, 1.0 / steps, 0.5);
    return filter;
  };
  const BoxFilter slow = predicted(10), fast = predicted(30);
  EXPECT_NEAR((slow.state() - fast.state()).norm(), 0, 1e-9);
  EXPECT_NEAR(slow.positionSigma() / fast.positionSigma(), 1, 0.05);
}

TEST(BoxFilter, AnEdgeThatIsLeftOpenDoesNotMoveTheOthers) {
  BoxFilter filter(measured({96, 200, 40, 80}));
  for (int k = 1; k < 60; ++k) {  // leftwards and out of the image: its left edge is behind the border
    const double left = 96 - 2 * k;
    const double visible = std::max(0.0, left);
    BoxMeasurement seen = measured({visible, 200, left + 40 - visible, 80});
    if (left <= 0) seen.variance_px2(0) += 1600;
    filter.predict(kStill, 1.0 / 24, kSteady_s);
    filter.update(seen);
    EXPECT_NEAR(filter.box().br().x, left + 40, 2);
    EXPECT_GT(filter.box().width, 30) << "nearly as wide as it was";
  }
}

TEST(BoxFilter, TheGateHoldsAsOftenAsItSays) {
  std::mt19937 generator(1);
  std::normal_distribution<double> noise(0, 2);
  const double gate = chiSquareQuantile(0.95, 2);
  int inside = 0, all = 0;
  for (int run = 0; run < 100; ++run) {
    BoxFilter filter(measured({300, 200, 40, 40}, 2));
    for (int k = 0; k < 20; ++k) {
      BoxMeasurement next = measured({300, 200, 40, 40}, 2);
      for (int edge = 0; edge < 4; ++edge) next.edges_px(edge) += noise(generator);
      if (k > 0) inside += filter.centreDistance(next) < gate ? 1 : 0;
      if (k > 0) ++all;
      filter.update(next);
    }
  }
  EXPECT_NEAR(static_cast<double>(inside) / all, 0.95, 0.04);
}

}  // namespace
}  // namespace redbee
