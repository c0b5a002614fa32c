#include "redbee/simulation/flight_simulator.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <iostream>
#include <opencv2/core/eigen.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "redbee/simulation/scenarios.hpp"

namespace redbee::simulation {
namespace {

Scenario noiseless(Scenario scenario) {
  scenario.sensor.noise_sigma = 0;
  return scenario;
}

bool same(const cv::Mat& a, const cv::Mat& b) { return cv::norm(a, b, cv::NORM_INF) == 0; }

/// Mean absolute grey difference between `after` and `before` warped by H, where `where` is set and the warp
/// stays inside.
double residual(const cv::Mat& before, const cv::Mat& after, const Eigen::Matrix3d& H, const cv::Mat& where) {
  cv::Mat H_cv, warped, covered, difference;
  cv::eigen2cv(H, H_cv);
  cv::warpPerspective(before, warped, H_cv, before.size(), cv::INTER_CUBIC);
  cv::warpPerspective(cv::Mat(before.size(), CV_8U, cv::Scalar(255)), covered, H_cv, before.size(),
                      cv::INTER_NEAREST);
  cv::erode(covered & where, covered, cv::Mat(), {-1, -1}, 4, cv::BORDER_CONSTANT, 0);
  cv::absdiff(after, warped, difference);
  return cv::mean(difference, covered)[0];
}

Eigen::Matrix3d shifted(const Eigen::Matrix3d& H, double dx, double dy) {
  Eigen::Matrix3d shift = Eigen::Matrix3d::Identity();
  shift.col(2).head<2>() << dx, dy;
  return shift * H;
}

void expectExact(const FlightSimulator& flight, int k, const Eigen::Matrix3d& H, int surface,
                 const char* name) {
  const RenderedImage before = flight.frame(k - 1).image, after = flight.frame(k).image;
  const cv::Mat where = after.surface == surface;
  ASSERT_GT(cv::countNonZero(where), 10000);
  const double exact = residual(before.grey, after.grey, H, where);
  const double noise = flight.scenario().sensor.noise_sigma;
  // White noise on both images; resampling can only lower its share.
  const double noise_level = std::sqrt(2 / M_PI) * noise * std::sqrt(2.0);
  std::cout << name << ": exact " << exact << ", noise alone " << noise_level;
  for (const auto& [dx, dy] : {std::pair{0.5, 0.0}, {-0.5, 0.0}, {0.0, 0.5}, {0.0, -0.5}}) {
    const double off = residual(before.grey, after.grey, shifted(H, dx, dy), where);
    std::cout << ", off " << off;
    EXPECT_GT(off, 1.25 * exact) << name << " shifted by " << dx << ", " << dy;
  }
  std::cout << " grey levels\n";
  EXPECT_LT(exact, 1.2 * noise_level + 0.3);
}

TEST(FlightSimulator, TheGroundFollowsItsHomography) {
  const FlightSimulator flight(groundOnly(3));
  for (const int k : {1, 40, 111}) expectExact(flight, k, flight.homography(k), kSurfaceGround, "ground");
}

TEST(FlightSimulator, TheFacadeFollowsItsOwnHomography) {
  const FlightSimulator flight(twoPlanes(3));
  const int k = 120;
  expectExact(flight, k, flight.frontHomography(k, kFacadePatch), 1 + static_cast<int>(kFacadePatch),
              "facade");
}

TEST(FlightSimulator, WithoutNoiseTheHomographyIsExactToATenthOfAPixel) {
  const FlightSimulator flight(noiseless(groundOnly(4)));
  const int k = 30;
  const RenderedImage before = flight.frame(k - 1).image, after = flight.frame(k).image;
  const cv::Mat where = after.surface == kSurfaceGround;
  const double exact = residual(before.grey, after.grey, flight.homography(k), where);
  for (const auto& [dx, dy] : {std::pair{0.1, 0.0}, {-0.1, 0.0}, {0.0, 0.1}, {0.0, -0.1}}) {
    EXPECT_GT(residual(before.grey, after.grey, shifted(flight.homography(k), dx, dy), where), exact);
  }
}

TEST(FlightSimulator, DistortionMovesTheImageAsTheCameraModelDoes) {
  Scenario scenario = noiseless(groundOnly(5));
  const RenderedImage ideal = FlightSimulator(scenario).frame(10).image;
  scenario.intrinsics.distortion = {-0.15, 0.04, 1e-3, -5e-4, 0};
  const FlightSimulator flight(scenario);
  const RenderedImage raw = flight.frame(10).image;
  cv::Mat_<cv::Vec2f> map(raw.grey.size());
  for (int y = 0; y < map.rows; ++y) {
    for (int x = 0; x < map.cols; ++x) {
      const Eigen::Vector2d pixel = *flight.camera().undistort({x, y});
      map(y, x) = {static_cast<float>(pixel.x()), static_cast<float>(pixel.y())};
    }
  }
  cv::Mat expected, difference;
  cv::remap(ideal.grey, expected, map, cv::noArray(), cv::INTER_CUBIC);
  cv::absdiff(expected, raw.grey, difference);
  const cv::Rect middle(120, 90, 400, 300);
  EXPECT_LT(cv::mean(difference(middle))[0], 1.0);
  cv::absdiff(ideal.grey, raw.grey, difference);
  EXPECT_GT(cv::mean(difference(middle))[0], 3.0);
}

TEST(FlightSimulator, TheMaskIsWhereTheMoverProjects) {
  const Scenario scenario = twoPlanes(6);
  const FlightSimulator flight(scenario);
  const int k = 60;
  const cv::Mat mask = flight.frame(k).image.mask;
  const Patch& car = scenario.scene.patches[1];
  const CameraPose pose = flight.pose(k);
  const Eigen::Vector3d centre = car.centre + car.motion.displacementAt(flight.exposureTime(k));
  std::vector<cv::Point2f> corners;
  for (const auto& [u, v] : {std::pair{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}) {
    const Eigen::Vector3d corner = centre + u * car.width_m * car.axis_u + v * car.height_m * car.axis_v;
    const Eigen::Vector2d pixel = (flight.camera().K() * pose.R_CG * (corner - pose.p_GC)).hnormalized();
    corners.emplace_back(static_cast<float>(pixel.x()), static_cast<float>(pixel.y()));
  }
  int inside = 0;
  for (int y = 0; y < mask.rows; ++y) {
    for (int x = 0; x < mask.cols; ++x) {
      const double depth =
          cv::pointPolygonTest(corners, {static_cast<float>(x), static_cast<float>(y)}, true);
      if (std::abs(depth) < 0.01) continue;
      EXPECT_EQ(mask.at<uchar>(y, x), depth > 0 ? kMaskMoving : 0) << x << ", " << y;
      inside += depth > 0 ? 1 : 0;
    }
  }
  EXPECT_GT(inside, 500);
}

TEST(FlightSimulator, AMoverThatStandsStillIsLabelledStopped) {
  const FlightSimulator flight(walkers(1));
  const auto labelOfFirst = [&flight](int k) {
    const RenderedImage image = flight.frame(k).image;
    double low = 0, high = 0;
    cv::minMaxLoc(image.mask, &low, &high, nullptr, nullptr, image.id == 1);
    EXPECT_EQ(low, high);
    return high;
  };
  EXPECT_EQ(labelOfFirst(60), kMaskMoving);
  EXPECT_EQ(labelOfFirst(96), kMaskStopped);
  EXPECT_EQ(labelOfFirst(130), kMaskMoving);
}

TEST(FlightSimulator, WavesAreBackgroundAndDoNotFollowTheGround) {
  const auto pondResidual = [](const Scenario& scenario) {
    const FlightSimulator flight(scenario);
    const RenderedImage before = flight.frame(19).image, after = flight.frame(20).image;
    const cv::Mat pond = after.surface == 1 + static_cast<int>(kPondPatch);
    EXPECT_EQ(cv::countNonZero(after.mask & pond), 0);
    return residual(before.grey, after.grey, flight.frontHomography(20, kPondPatch), pond);
  };
  const Scenario waving = noiseless(wavingWater(2));
  Scenario frozen = waving;
  frozen.scene.patches[kPondPatch].waving.reset();
  const double with_waves = pondResidual(waving), without = pondResidual(frozen);
  std::cout << "residual on the pond: waving " << with_waves << ", frozen " << without << " grey levels\n";
  EXPECT_GT(with_waves, 3 * without);
}

TEST(FlightSimulator, TheSeedDecidesEverything) {
  const FlightSimulator first(twoPlanes(9)), second(twoPlanes(9)), other(twoPlanes(10));
  second.frame(3);
  EXPECT_TRUE(same(first.frame(7).image.grey, second.frame(7).image.grey));
  EXPECT_FALSE(same(first.frame(7).image.grey, other.frame(7).image.grey));
  EXPECT_EQ(first.imu()[50].gyro, second.imu()[50].gyro);
  EXPECT_EQ(first.altimeter()[5].height_m, second.altimeter()[5].height_m);
}

TEST(FlightSimulator, NoiseIsThatOfTheSensor) {
  Scenario scenario = groundOnly(1);
  scenario.sensor.noise_sigma = 3;
  cv::Mat noisy, clean, mean, deviation;
  FlightSimulator(scenario).frame(2).image.grey.convertTo(noisy, CV_32F);
  FlightSimulator(noiseless(scenario)).frame(2).image.grey.convertTo(clean, CV_32F);
  cv::meanStdDev(noisy - clean, mean, deviation, clean < 240);
  // Both images are rounded to whole grey levels: a twelfth of a level squared each.
  EXPECT_NEAR(deviation.at<double>(0), std::sqrt(9 + 2.0 / 12), 0.05);
  EXPECT_NEAR(mean.at<double>(0), 0, 0.05);
}

TEST(FlightSimulator, ColourHasTheSameGreyLevels) {
  Scenario scenario = noiseless(wavingWater(1));
  scenario.sensor.colour = true;
  const RenderedImage image = FlightSimulator(scenario).frame(0).image;
  cv::Mat grey;
  cv::cvtColor(image.bgr, grey, cv::COLOR_BGR2GRAY);
  cv::absdiff(grey, image.grey, grey);
  EXPECT_LT(cv::mean(grey)[0], 1.5);
}

TEST(FlightSimulator, TheImuClockRunsAheadOfTheCamerasByTheTimeShift) {
  Scenario scenario = groundOnly(1);
  scenario.extrinsics.timeshift_s = 0.02;
  const FlightSimulator flight(scenario);
  EXPECT_EQ(flight.frameTime(24), CameraTime(scenario.start + std::chrono::seconds(1)));
  EXPECT_NEAR(flight.exposureTime(24), 1.02, 1e-9);
  EXPECT_LT(flight.imu().front().time, toImu(flight.frameTime(0), Duration(0)));
  EXPECT_GT(flight.imu().back().time, toImu(flight.frameTime(scenario.frames - 1), Duration(0)));
}

TEST(FlightSimulator, ImpossibleScenariosAreRefused) {
  Scenario scenario = groundOnly(1);
  scenario.fps = 0;
  EXPECT_THROW(FlightSimulator{scenario}, std::invalid_argument);
  EXPECT_THROW(FlightSimulator(twoPlanes(1)).frontHomography(3, 1), std::invalid_argument);
}

TEST(FlightSimulator, ALensThatZoomsShowsWhatACameraOfThatFocalLengthDoes) {
  const Scenario scenario = zoomWalkers(3);
  const FlightSimulator flight(scenario);
  constexpr int kFrame = 30;
  Scenario fixed = scenario;
  fixed.lens.reset();
  fixed.intrinsics = zoomed(scenario.intrinsics, flight.zoom(kFrame));
  EXPECT_GT(flight.zoom(kFrame), 1.2);
  EXPECT_TRUE(same(flight.frame(kFrame).image.grey, FlightSimulator(fixed).frame(kFrame).image.grey));
  fixed.intrinsics = scenario.intrinsics;
  EXPECT_FALSE(same(flight.frame(kFrame).image.grey, FlightSimulator(fixed).frame(kFrame).image.grey));
  expectExact(flight, kFrame, flight.homography(kFrame), kSurfaceGround, "ground of a lens that zooms");
}

TEST(FlightSimulator, TheLensSaysItsFocalLength) {
  Scenario scenario = zoomWalkers(3);
  scenario.lens->error_sigma = 0;
  scenario.lens->lag_s = 0.04;
  const FlightSimulator flight(scenario);
  for (const LensSample& said : flight.lens()) {
    const double t_s = seconds(said.time - ImuTime(scenario.start));
    EXPECT_NEAR(said.zoom, scenario.lens->zoom(t_s - 0.04), 1e-4);
  }
  EXPECT_TRUE(FlightSimulator(walkers(3)).lens().empty());
}

}  // namespace
}  // namespace redbee::simulation
