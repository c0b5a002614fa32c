#include "redbee/geometry/rolling_shutter.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "redbee/geometry/so3.hpp"

namespace redbee::test {
namespace {

constexpr double kReadout_s = 0.025;
constexpr double kHeight_m = 8;

CameraIntrinsics rolling(CameraIntrinsics camera) {
  camera.line_delay_s = kReadout_s / camera.height;
  return camera;
}
CameraIntrinsics pinhole() { return rolling({640, 480, 500, 500, 319.5, 239.5, {}}); }
CameraIntrinsics barrel() { return rolling({640, 480, 500, 500, 319.5, 239.5, {-0.2, 0.05, 0, 0, 0}}); }
CameraIntrinsics fisheye() {
  return rolling({640, 480, 305, 305, 319.5, 239.5, {-0.018, 0.0075, -0.0042, 0.0006}, "equidistant"});
}

/// A drone that turns by 1.3 rad/s and flies at 6 m/s, 8 m above the ground; camera 40 degrees down.
RowMotion brisk() {
  RowMotion motion;
  motion.rate = {0.4, 1.1, -0.5};
  motion.acceleration = {3, -6, 2};
  motion.velocity = Eigen::Vector3d(1, 0.5, 6) / kHeight_m;
  motion.normal = Eigen::Vector3d(0.1, std::cos(0.7), std::sin(0.7)).normalized();
  return motion;
}

/// Raw pixel of a point at rest (in C at the middle row's time), by its world: the camera moves, and the row
/// that is exposed where the point is seen is found by bisection.
Eigen::Vector2d seen(const Camera& camera, const RowMotion& motion, const Eigen::Vector3d& X) {
  const auto pixelAt = [&](double tau_s) -> Eigen::Vector2d {
    const Eigen::Matrix3d R_0t = expSO3(motion.rate * tau_s + 0.5 * tau_s * tau_s * motion.acceleration);
    const Eigen::Vector3d place = kHeight_m * motion.velocity * tau_s;
    return *camera.model().project(R_0t.transpose() * (X - place));
  };
  double low = -kReadout_s, high = kReadout_s;
  for (int i = 0; i < 60; ++i) {
    const double tau_s = (low + high) / 2;
    const bool is_row_later = rowTime(camera.intrinsics(), pixelAt(tau_s).y()) > tau_s;
    (is_row_later ? low : high) = tau_s;
  }
  return pixelAt(low);
}

class RollingShutter : public testing::TestWithParam<CameraIntrinsics> {};

TEST_P(RollingShutter, PointsOnTheGroundAreSeenWhereTheMovingCameraSeesThem) {
  const Camera camera(GetParam());
  const RowMotion motion = brisk();
  double largest_px = 0;
  for (const double u : {60.0, 320.0, 590.0}) {
    for (const double v : {150.0, 300.0, 450.0}) {
      const auto ray = camera.model().unproject({u, v});
      ASSERT_TRUE(ray);
      const Eigen::Vector3d X = *ray * kHeight_m / motion.normal.dot(*ray);
      const Eigen::Vector2d truth = seen(camera, motion, X);
      const Eigen::Vector2d ideal = (camera.K() * X).hnormalized();
      const auto raw = rawPixel(camera, ideal, motion);
      ASSERT_TRUE(raw);
      EXPECT_LT((*raw - truth).norm(), 1e-3);
      const auto back = idealPixel(camera, truth, motion);
      ASSERT_TRUE(back);
      EXPECT_LT((*back - ideal).norm(), 1e-3);
      largest_px = std::max(largest_px, (truth - Eigen::Vector2d(u, v)).norm());
    }
  }
  EXPECT_GT(largest_px, 3) << "there is something to correct";
}

TEST_P(RollingShutter, AboveTheHorizonOnlyTheRotationCounts) {
  const Camera camera(GetParam());
  RowMotion motion = brisk();
  motion.normal = -motion.normal;  // all of the view
  const auto moved = rawPixel(camera, {200, 100}, motion);
  motion.velocity.setZero();
  EXPECT_EQ(*moved, *rawPixel(camera, {200, 100}, motion));
}

TEST_P(RollingShutter, TheMiddleRowStays) {
  const Camera camera(GetParam());
  const auto ideal = camera.undistort({100, 239.5});
  ASSERT_TRUE(ideal);
  EXPECT_LT((*rawPixel(camera, *ideal, brisk()) - Eigen::Vector2d(100, 239.5)).norm(), 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Lenses, RollingShutter, testing::Values(pinhole(), barrel(), fisheye()));

TEST(RowMotion, EarlierIsTheInverseOfLater) {
  const RowMotion motion = brisk();
  for (const Eigen::Vector3d& ray : {Eigen::Vector3d(0.3, 0.5, 1), Eigen::Vector3d(-0.4, -0.9, 1)}) {
    for (const double tau_s : {-0.0125, 0.004, 0.0125})
      EXPECT_LT((motion.earlier(motion.later(ray, tau_s), tau_s) - ray).norm(), 1e-12);
  }
}

TEST(RowTime, RunsFromTopToBottomAroundTheMiddleRow) {
  EXPECT_DOUBLE_EQ(rowTime(pinhole(), 0), -239.5 * kReadout_s / 480);
  EXPECT_DOUBLE_EQ(rowTime(pinhole(), 479), 239.5 * kReadout_s / 480);
  EXPECT_DOUBLE_EQ(halfReadout(pinhole()), 239.5 * kReadout_s / 480);
  CameraIntrinsics upwards = pinhole();
  upwards.line_delay_s *= -1;
  EXPECT_GT(rowTime(upwards, 0), 0);
  EXPECT_DOUBLE_EQ(halfReadout(upwards), halfReadout(pinhole()));
}

}  // namespace
}  // namespace redbee::test
