#include "redbee/detection/parallax/point_paths.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "redbee/detection/parallax/moving_points.hpp"
#include "redbee/imaging/warping.hpp"

namespace redbee {
namespace {

constexpr double kFocal_px = 250, kHeight_m = 10;
const cv::Size kSize{320, 240};

Eigen::Matrix3d camera() {
  Eigen::Matrix3d K;
  K << kFocal_px, 0, 160, 0, kFocal_px, 120, 0, 0, 1;
  return K;
}

cv::Mat1b texture(cv::Size size, int seed) {
  cv::RNG random(static_cast<uint64_t>(seed));
  cv::Mat1b noise(size), smooth;
  random.fill(noise, cv::RNG::UNIFORM, 0, 256);
  cv::GaussianBlur(noise, smooth, {0, 0}, 1.5);
  cv::normalize(smooth, smooth, 20, 230, cv::NORM_MINMAX);
  return smooth;
}

/// A camera that looks straight down and flies to the right and ahead in turns, over textured ground, with a
/// square patch in view.
class Flight {
 public:
  explicit Flight(double rate_hz = 24) : rate_hz_(rate_hz) {}

  /// `patch`: its place in the image with the ground point under the first image's centre as origin, at the
  /// `depth` of a surface (the ground's is kHeight_m) [m], `velocity` over the ground [m/s].
  void run(double seconds, double depth, const Eigen::Vector2d& velocity) {
    const cv::Mat1b ground = texture({900, 900}, 1), patch = texture({16, 16}, 2);
    Eigen::Vector2d before = position(0);
    for (int k = 0; k <= std::lround(seconds * rate_hz_); ++k) {
      const double t = k / rate_hz_;
      const Eigen::Vector2d now = position(t);
      if (k > 0) {
        PlaneMotion motion;
        motion.R_ba.setIdentity();
        motion.t_ba << before - now, 0;
        motion.m_a = Eigen::Vector3d::UnitZ();
        motion.h_a = kHeight_m;
        paths_.propagate(planeHomography(camera(), motion), motion);
      }
      paths_.update(CameraTime(fromSeconds(1 + t)), render(ground, patch, now, velocity * t, depth), camera(),
                    excluded_);
      before = now;
    }
  }
  void exclude(const cv::Rect& box) {
    excluded_ = cv::Mat1b::zeros(kSize);
    excluded_(box).setTo(255);
  }
  std::vector<cv::Point> moving() const { return movingPoints(paths_.paths(), 2); }
  const std::vector<PointPath>& paths() const { return paths_.paths(); }
  cv::Rect patch() const { return patch_; }

 private:
  /// Ahead and back while it goes right: no static depth explains a straight line over the ground then.
  static Eigen::Vector2d position(double t) { return {1.5 * t, 1.2 * std::sin(2 * t)}; }

  cv::Mat1b render(const cv::Mat1b& ground, const cv::Mat1b& patch, const Eigen::Vector2d& at_m,
                   const Eigen::Vector2d& moved_m, double depth) {
    const double scale = kFocal_px / kHeight_m;
    const cv::Matx23d shift(1, 0, scale * at_m.x() + 200, 0, 1, scale * at_m.y() + 200);
    cv::Mat1b image;
    cv::warpAffine(ground, image, shift, kSize, cv::INTER_LINEAR | cv::WARP_INVERSE_MAP);
    const Eigen::Vector2d corner =
        Eigen::Vector2d(190, 110) + kFocal_px / depth * (moved_m - at_m);  // px, of the patch
    const cv::Matx23d place(1, 0, corner.x(), 0, 1, corner.y());
    cv::warpAffine(patch, image, place, kSize, cv::INTER_LINEAR, cv::BORDER_TRANSPARENT);
    patch_ = cv::Rect(cvRound(corner.x()), cvRound(corner.y()), patch.cols, patch.rows);
    return image;
  }

  double rate_hz_;
  PointPaths paths_{ParallaxParameters{}};
  cv::Rect patch_;
  cv::Mat1b excluded_;
};

int inside(const std::vector<cv::Point>& points, cv::Rect box) {
  box = cv::Rect(box.x - 3, box.y - 3, box.width + 6, box.height + 6);
  return static_cast<int>(
      std::count_if(points.begin(), points.end(), [&](const cv::Point& p) { return box.contains(p); }));
}

class PointPathsAt : public testing::TestWithParam<double> {};

TEST_P(PointPathsAt, WhatMovesSlowlyOverTheGroundIsFoundAndNothingElse) {
  Flight flight(GetParam());
  flight.run(1.2, kHeight_m, {-0.5, 0.4});  // 0.7 px in 0.083 s, less than the dense flow's error
  EXPECT_GE(inside(flight.moving(), flight.patch()), 2);
  EXPECT_EQ(inside(flight.moving(), flight.patch()), static_cast<int>(flight.moving().size()));
}

INSTANTIATE_TEST_SUITE_P(Rates, PointPathsAt, testing::Values(12.0, 24.0, 60.0));

/// As the vehicle's own parts are.
TEST(PointPaths, WhatIsExcludedIsNotFollowed) {
  const cv::Rect box(100, 60, 120, 80);
  const auto followed = [&](bool is_excluded) {
    Flight flight;
    if (is_excluded) flight.exclude(box);
    flight.run(0.5, kHeight_m, {0, 0});
    return std::count_if(flight.paths().begin(), flight.paths().end(), [&](const PointPath& path) {
      return box.contains(cv::Point(cvRound(path.at.x()), cvRound(path.at.y())));
    });
  };
  EXPECT_GT(followed(false), 10);
  EXPECT_EQ(followed(true), 0);
}

TEST(PointPaths, WhatStandsAboveTheGroundRests) {
  for (const double depth : {8.0, 5.0}) {
    Flight flight;
    flight.run(1.2, depth, {0, 0});
    EXPECT_TRUE(flight.moving().empty()) << depth;
  }
}

TEST(PointPaths, GroundRests) {
  Flight flight;
  flight.run(1.2, kHeight_m, {0, 0});
  EXPECT_TRUE(flight.moving().empty());
  EXPECT_GT(flight.paths().size(), 200U);
  const auto tested = std::count_if(flight.paths().begin(), flight.paths().end(),
                                    [](const PointPath& path) { return path.isTested(); });
  EXPECT_GT(tested, 150);
}

TEST(PointPaths, PathsBeginAnewWithoutTheCamerasMotion) {
  PointPaths paths{ParallaxParameters{}};
  const cv::Mat1b image = texture(kSize, 3);
  PlaneMotion still{Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ(),
                    kHeight_m};
  for (int k = 0; k < 12; ++k) {
    if (k > 0) paths.propagate(Eigen::Matrix3d::Identity(), still);
    paths.update(CameraTime(fromSeconds(1 + 0.1 * k)), image, camera());
  }
  EXPECT_TRUE(std::any_of(paths.paths().begin(), paths.paths().end(),
                          [](const PointPath& path) { return path.sampled > 8; }));
  paths.propagate(Eigen::Matrix3d::Identity(), std::nullopt);
  paths.update(CameraTime(fromSeconds(2.2)), image, camera());
  EXPECT_TRUE(std::all_of(paths.paths().begin(), paths.paths().end(),
                          [](const PointPath& path) { return path.sampled <= 1; }));
}

TEST(PointPaths, NothingIsFollowedOnTheVehicle) {
  PointPaths paths{ParallaxParameters{}};
  cv::Mat1b vehicle = cv::Mat1b::zeros(kSize);
  vehicle(cv::Rect(0, 120, 320, 120)) = 255;
  paths.update(CameraTime(fromSeconds(1)), texture(kSize, 3), camera(), vehicle);
  EXPECT_FALSE(paths.paths().empty());
  for (const PointPath& path : paths.paths()) EXPECT_LT(path.at.y(), 120);
}

TEST(MovingRegion, ReachesWhereTheAppearanceDiffersAndNotIntoShadows) {
  cv::Mat1f difference = cv::Mat1f::zeros(60, 80);
  difference(cv::Rect(20, 20, 4, 9)) = 0.8F;   // an object
  difference(cv::Rect(60, 20, 4, 9)) = 0.25F;  // a cast shadow
  const cv::Mat1f region = movingRegion({{21, 22}, {61, 22}}, difference, difference.size(), 2);
  EXPECT_GT(region(24, 23), 0.9F);
  EXPECT_EQ(region(24, 26), 0.0F);
  EXPECT_EQ(region(28, 21), 0.0F);  // farther than 10 px at full size
  EXPECT_LT(region(22, 61), 0.2F);
  EXPECT_TRUE(movingRegion({}, difference, difference.size(), 2).empty());
}

}  // namespace
}  // namespace redbee
