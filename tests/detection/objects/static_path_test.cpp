#include "redbee/detection/objects/static_path.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

#include "redbee/detection/objects/log_odds.hpp"

namespace redbee {
namespace {

constexpr double kPeriod_s = 1.0 / 24;
constexpr double kVariance_px2 = 4;
constexpr double kHeight_m = 10, kSpeed_mps = 4;
constexpr double kDirectionError = 0.05;

Eigen::Matrix3d camera() {
  Eigen::Matrix3d K;
  K << 500, 0, 320, 0, 500, 240, 0, 0, 1;
  return K;
}

/// A camera that looks 40 degrees down and flies to its right, yawing a little; ground frame: z up, x right,
/// y ahead.
class Flight {
 public:
  explicit Flight(double speed_mps = kSpeed_mps, double period_s = kPeriod_s)
      : speed_mps_(speed_mps), period_s_(period_s) {}

  void step() {
    const Eigen::Matrix3d before = R_CG();
    const Eigen::Vector3d was = position();
    ++k_;
    PlaneMotion motion;
    motion.R_ba = R_CG() * before.transpose();
    motion.t_ba = R_CG() * (was - position());
    motion.m_a = before * -Eigen::Vector3d::UnitZ();
    motion.h_a = kHeight_m;
    path_.propagate(period_s_, planeHomography(camera(), motion), CameraStep{motion, camera()});
  }
  Eigen::Vector2d project(const Eigen::Vector3d& point_m) const {
    return (camera() * R_CG() * (point_m - position())).hnormalized();
  }
  /// Of a point that goes from `start_m` at `velocity`, seen for a second and a half.
  std::optional<double> likelihood(const Eigen::Vector3d& start_m,
                                   const Eigen::Vector3d& velocity = Eigen::Vector3d::Zero(),
                                   double seconds = 1.4) {
    std::deque<PathPoint> points;
    for (int i = 0; i <= std::lround(seconds / period_s_); ++i) {
      if (i > 0) step();
      points.push_back({path_.current(), project(start_m + i * period_s_ * velocity),
                        Eigen::Vector2d::Constant(kVariance_px2)});
    }
    return movingLogLikelihood(points, path_, kDirectionError);
  }
  CameraPath& path() { return path_; }

 private:
  Eigen::Vector3d position() const { return {k_ * period_s_ * speed_mps_, 0, kHeight_m}; }
  Eigen::Matrix3d R_CG() const {
    Eigen::Matrix3d level;  // looks ahead
    level << 1, 0, 0, 0, 0, -1, 0, 1, 0;
    const double yaw = 0.05 * k_ * period_s_;
    return Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitX()) * level *
           Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ());
  }

  double speed_mps_, period_s_;
  int k_ = 0;
  CameraPath path_{0.15};
};

TEST(StaticPath, AStepLongerThanTheMemoryLeavesNothingToRemember) {
  Flight flight(kSpeed_mps, 1.6);
  flight.step();
  flight.step();
  EXPECT_EQ(flight.path().current(), 2);
  EXPECT_TRUE(flight.path().remembers(2));
  EXPECT_FALSE(flight.path().remembers(1));
  EXPECT_FALSE(flight.path().remembers(0));
}

TEST(StaticPath, ADirectionWithoutErrorIsNoReasonToRest) {
  Flight flight;
  std::deque<PathPoint> points;
  for (int i = 0; i <= 24; ++i) {
    if (i > 0) flight.step();
    points.push_back({flight.path().current(), flight.project({3, 8 + 1.5 * i * kPeriod_s, 0}),
                      Eigen::Vector2d::Constant(kVariance_px2)});
  }
  EXPECT_GT(*movingLogLikelihood(points, flight.path(), 0), 5);
}

TEST(StaticPath, OneWhiteningForAllSightingsNeedsNoMoreThanSums) {
  std::srand(7);
  const auto random = [] { return Eigen::Vector2d(Eigen::Vector2d::Random()); };
  for (int trial = 0; trial < 200; ++trial) {
    Eigen::Matrix2d whitening = 2 * Eigen::Matrix2d::Identity();
    whitening += Eigen::Matrix2d(Eigen::Matrix2d::Random());
    const Eigen::Vector2d travel = 30 * random(), velocity = 5 * random();
    std::vector<PathObservation> observations;
    UniformPathFit sums;
    for (int i = 0; i < 8; ++i) {
      const double age_s = 0.08 * i;
      // Without travel no depth is seen.
      const Eigen::Vector2d parallax =
          trial % 4 == 0 ? Eigen::Vector2d::Zero() : Eigen::Vector2d(age_s * travel);
      const CameraPath::Sighting seen{
          age_s, -0.4 * parallax - (trial % 2) * age_s * velocity + 0.3 * random(), parallax};
      observations.push_back({seen, whitening});
      sums.add(seen);
    }
    const double direction_error = trial % 3 == 0 ? 0 : kDirectionError;
    const PathFit expected = fitPath(observations, direction_error),
                  fit = sums.solve(whitening, direction_error);
    // The weak prior of fitPath() takes that much of a fast point's.
    EXPECT_NEAR(fit.static_chi2, expected.static_chi2, 1e-5 * (1 + expected.static_chi2));
    EXPECT_NEAR(fit.moving_chi2, expected.moving_chi2, 1e-5 * (1 + expected.moving_chi2));
  }
}

TEST(StaticPath, APointAtAnyDepthRests) {
  for (const double height_m : {0.0, 1.0, 4.0, 8.0}) {
    // Negative where the path is curved, which a constant velocity does not explain.
    EXPECT_LT(*Flight().likelihood({3, 6, height_m}), 0.01) << height_m << " m above the ground";
  }
  EXPECT_NEAR(*Flight().likelihood({1000, 1e6, 2e4}), 0, 0.01) << "above the horizon";
}

/// Of n points with variance s^2, a steady motion across v takes v^2 / s^2 sum (t - mean t)^2 off the
/// chi-square, of which one point in 0.17 s counts.
TEST(StaticPath, WhatMovesAcrossIsWorthItsChiSquare) {
  Flight hovering(0);
  const Eigen::Vector3d ahead(0, kHeight_m / std::tan(0.7), 0);  // in the image's centre
  const double speed_mps = 0.8;
  const double v_px_s = 500 * speed_mps / std::hypot(kHeight_m, ahead.y());
  double sum = 0;
  const int n = static_cast<int>(std::lround(1.4 / kPeriod_s)) + 1;
  for (int i = 0; i < n; ++i) sum += std::pow((i - 0.5 * (n - 1)) * kPeriod_s, 2);
  const double chi_square = v_px_s * v_px_s * sum / kVariance_px2;
  const double expected = 0.5 * chi_square * kPeriod_s / 0.17;
  EXPECT_NEAR(*hovering.likelihood(ahead, {speed_mps, 0, 0}), expected, 0.02 * expected);
}

TEST(StaticPath, WhatMovesAcrossTheTravelMovesWhateverItsDepth) {
  EXPECT_GT(*Flight().likelihood({3, 8, 0}, {0, 1.5, 0}), 10);
  EXPECT_GT(*Flight().likelihood({3, 8, 4}, {0, 1.5, 0}), 10);
}

TEST(StaticPath, WhatMovesAlongTheTravelCannotBeToldFromASurfaceOfAnotherDepth) {
  // Against the drone, as the parallax of a nearer surface is.
  EXPECT_NEAR(*Flight().likelihood({3, 8, 0}, {-1, 0, 0}), 0, 0.5);
  EXPECT_GT(*Flight().likelihood({3, 8, 0}, {1, 0, 0}), 2) << "but below the ground there is none";
}

TEST(StaticPath, TheLikelihoodIsThatOfTenAndOfThirtyHertz) {
  const Eigen::Vector3d start(3, 8, 0), velocity(0, 0.4, 0);
  const double slow = *Flight(kSpeed_mps, 0.1).likelihood(start, velocity);
  const double fast = *Flight(kSpeed_mps, 1.0 / 30).likelihood(start, velocity);
  EXPECT_NEAR(slow, fast, 0.15 * fast);
}

TEST(StaticPath, SaysNothingOfAFewFramesOrAnUnknownMotion) {
  EXPECT_FALSE(Flight().likelihood({3, 8, 0}, {0, 1, 0}, 2.4 * kPeriod_s));
  EXPECT_TRUE(Flight().likelihood({3, 8, 0}, {0, 1, 0}, 3.4 * kPeriod_s));
  Flight flight;
  flight.likelihood({3, 8, 0});
  const int64_t before = flight.path().current();
  EXPECT_TRUE(flight.path().remembers(before));
  flight.path().propagate(kPeriod_s, Eigen::Matrix3d::Identity(), std::nullopt);
  EXPECT_FALSE(flight.path().remembers(before));
  EXPECT_FALSE(flight.path().remembers(before + 2)) << "a frame to come";
}

TEST(StaticPath, ForgetsWhatIsOlderThanASecondAndAHalf) {
  Flight flight;
  const int64_t first = flight.path().current();
  while (flight.path().remembers(first)) flight.step();
  EXPECT_NEAR(static_cast<double>(flight.path().current() - first) * kPeriod_s, 1.5, 1.01 * kPeriod_s);
}

TEST(MovingLogOdds, CountAgainstATrackFromHalfASecondOnAndForItWithinBounds) {
  EXPECT_EQ(movingLogOdds(0.4, 0), 0);
  EXPECT_EQ(movingLogOdds(0.6, 0), -1);
  EXPECT_EQ(movingLogOdds(0.6, -50), -1);
  EXPECT_EQ(movingLogOdds(0.4, 3), 2);
  EXPECT_NEAR(movingLogOdds(2, 1e6), std::log(19), 1e-12);
}

}  // namespace
}  // namespace redbee
