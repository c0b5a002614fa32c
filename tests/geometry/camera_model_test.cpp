#include "redbee/geometry/camera_model.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>

#include "redbee/geometry/angle.hpp"
#include "redbee/geometry/camera.hpp"

namespace redbee::test {
namespace {

/// EuRoC's camera, whose distortion moves the corners by more than 100 px.
CameraIntrinsics radtan() {
  return {
      752, 480, 458.654, 457.296, 367.215, 248.375, {-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05, 0}};
}

/// 122 degrees across.
CameraIntrinsics equidistant() {
  return {640, 480, 305, 303, 319.5, 239.5, {-0.018, 0.0075, -0.0042, 0.0006}, "equidistant"};
}

Eigen::Vector3d rayAt(double angle_deg, double direction_deg) {
  const double angle = angle_deg * kDegree, direction = direction_deg * kDegree;
  return {std::sin(angle) * std::cos(direction), std::sin(angle) * std::sin(direction), std::cos(angle)};
}

class CameraModels : public ::testing::TestWithParam<CameraIntrinsics> {
 protected:
  std::unique_ptr<const CameraModel> model_ = makeCameraModel(GetParam());
};

TEST_P(CameraModels, UnprojectsWhatItProjectsOverTheImage) {
  for (int v = 0; v < 480; v += 60) {
    for (int u = 0; u < GetParam().width; u += 60) {
      const Eigen::Vector2d pixel(u, v);
      const auto ray = model_->unproject(pixel);
      ASSERT_TRUE(ray) << u << ' ' << v;
      const auto again = model_->project(7 * *ray);
      ASSERT_TRUE(again) << u << ' ' << v;
      EXPECT_LT((*again - pixel).norm(), 1e-9) << u << ' ' << v;
    }
  }
}

TEST_P(CameraModels, HaveTheJacobianOfTheirDifferences) {
  constexpr double kStep = 1e-6;
  for (const double angle : {0.0, 1e-4, 5.0, 30.0, 45.0}) {
    const Eigen::Vector3d ray = 3 * rayAt(angle, 70);
    Eigen::Matrix<double, 2, 3> J, numeric;
    ASSERT_TRUE(model_->project(ray, &J));
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d step = kStep * Eigen::Vector3d::Unit(axis);
      numeric.col(axis) = (*model_->project(ray + step) - *model_->project(ray - step)) / (2 * kStep);
    }
    EXPECT_LT((J - numeric).norm(), 1e-5) << angle << '\n' << J << "\n\n" << numeric;
  }
}

TEST_P(CameraModels, RefuseARayThatHasNoDirection) {
  EXPECT_FALSE(model_->project(Eigen::Vector3d::Zero()));
  EXPECT_FALSE(model_->project({std::nan(""), 0, 1}));
  EXPECT_FALSE(model_->unproject({std::nan(""), 0}));
  EXPECT_FALSE(model_->project(-Eigen::Vector3d::UnitZ()));
}

INSTANTIATE_TEST_SUITE_P(Of, CameraModels, ::testing::Values(radtan(), equidistant()),
                         [](const auto& parameter) { return parameter.param.model; });

cv::Mat cameraMatrix(const CameraIntrinsics& camera) {
  return (cv::Mat_<double>(3, 3) << camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
}

TEST(EquidistantModel, ProjectsAsOpenCvsFisheyeDoes) {
  const CameraIntrinsics camera = equidistant();
  const auto model = makeCameraModel(camera);
  std::vector<cv::Point3d> points;
  for (const double angle : {0.0, 0.5, 20.0, 45.0, 60.0, 80.0}) {
    for (const double direction : {0.0, 50.0, 170.0, 300.0}) {
      const Eigen::Vector3d X = 4 * rayAt(angle, direction);
      points.emplace_back(X.x(), X.y(), X.z());
    }
  }
  std::vector<cv::Point2d> expected;
  cv::fisheye::projectPoints(points, expected, cv::Vec3d(), cv::Vec3d(), cameraMatrix(camera),
                             camera.distortion);
  for (size_t i = 0; i < points.size(); ++i) {
    const auto pixel = model->project({points[i].x, points[i].y, points[i].z});
    ASSERT_TRUE(pixel);
    EXPECT_LT((*pixel - Eigen::Vector2d(expected[i].x, expected[i].y)).norm(), 1e-6) << points[i];
  }
}

TEST(RadtanModel, ProjectsAsOpenCvDoes) {
  const CameraIntrinsics camera = radtan();
  const auto model = makeCameraModel(camera);
  const std::vector<cv::Point3d> points{{0, 0, 1}, {0.3, -0.2, 1.5}, {-2, 1, 3}};
  std::vector<cv::Point2d> expected;
  cv::projectPoints(points, cv::Vec3d(), cv::Vec3d(), cameraMatrix(camera), camera.distortion, expected);
  for (size_t i = 0; i < points.size(); ++i) {
    const auto pixel = model->project({points[i].x, points[i].y, points[i].z});
    ASSERT_TRUE(pixel);
    EXPECT_LT((*pixel - Eigen::Vector2d(expected[i].x, expected[i].y)).norm(), 1e-9);
  }
}

TEST(RadtanModel, RefusesRaysBeyondWhereTheLensFoldsOver) {
  CameraIntrinsics camera = radtan();
  camera.distortion = {-0.3, 0, 0, 0};
  const auto model = makeCameraModel(camera);
  const double limit = std::sqrt(1 / 0.9);  // 1 + 3 k1 r^2 = 0
  EXPECT_NEAR(std::tan(model->fieldOfView() / 2), limit, 1e-9);
  EXPECT_TRUE(model->project({0.999 * limit, 0, 1}));
  EXPECT_FALSE(model->project({1.001 * limit, 0, 1}));
  EXPECT_FALSE(model->project({0, 0, -1}));
  const double edge = camera.cx + camera.fx * limit * (1 - 0.3 * limit * limit);
  EXPECT_TRUE(model->unproject({edge - 1, camera.cy}));
  EXPECT_FALSE(model->unproject({edge + 1, camera.cy}));
}

TEST(EquidistantModel, SeesBehindTheCameraUpToItsFieldOfView) {
  CameraIntrinsics camera = equidistant();
  camera.distortion = {0, 0, 0, 0};
  const auto ideal = makeCameraModel(camera);
  EXPECT_NEAR(ideal->fieldOfView(), 2 * kPi, 1e-12);
  const auto behind = ideal->project(rayAt(110, 0));
  ASSERT_TRUE(behind);
  EXPECT_NEAR(behind->x(), camera.cx + camera.fx * 110 * kDegree, 1e-9);
  camera.distortion = {-0.1, 0, 0, 0};  // slope 1 - 0.3 a^2
  const auto folding = makeCameraModel(camera);
  EXPECT_NEAR(folding->fieldOfView() / 2, std::sqrt(1 / 0.3), 1e-9);
  EXPECT_FALSE(folding->project(rayAt(106, 0)));
  EXPECT_FALSE(folding->unproject({camera.cx + 2 * camera.fx, camera.cy}));
}

TEST(CameraModels, AreFoundUnderTheNamesOfCalibrationFiles) {
  for (const char* name : {"radtan", "radial-tangential", "Radial_Tangential", "plumb_bob"}) {
    ASSERT_NE(findCameraModel(name), nullptr) << name;
    EXPECT_EQ(findCameraModel(name)->name, "radtan");
  }
  for (const char* name : {"equidistant", "EQUIDISTANT", "equi", "kannala_brandt"}) {
    ASSERT_NE(findCameraModel(name), nullptr) << name;
    EXPECT_EQ(findCameraModel(name)->name, "equidistant");
  }
  EXPECT_EQ(findCameraModel("omni"), nullptr);
  CameraIntrinsics camera = equidistant();
  camera.distortion.push_back(0);
  EXPECT_THROW(makeCameraModel(camera), std::invalid_argument);
}

TEST(Camera, OfARadtanLensKeepsSizeAndKForTheIdealImage) {
  const Camera camera(radtan());
  EXPECT_EQ(camera.ideal().width, 752);
  EXPECT_EQ(camera.ideal().height, 480);
  EXPECT_EQ(camera.K()(0, 0), 458.654);
  EXPECT_EQ(camera.K()(0, 2), 367.215);
}

TEST(Camera, OfAWideLensChoosesAnIdealCameraThatKeepsTheCentresResolution) {
  const CameraIntrinsics raw = equidistant();
  const Camera camera(raw);
  EXPECT_TRUE(camera.isDistorted());
  EXPECT_EQ(camera.ideal().fx, raw.fx);
  EXPECT_EQ(camera.ideal().width % 8, 0);
  EXPECT_EQ(camera.ideal().height % 8, 0);
  const double across = 2 * std::atan(camera.ideal().width / 2.0 / raw.fx) / kDegree;
  EXPECT_GE(across, 105);
  EXPECT_LT(across, 106);
  // From top to bottom the lens itself shows less than that; the ideal image shows all of it.
  EXPECT_GE(camera.undistort({raw.cx, 0})->y(), -0.5);
  EXPECT_LT(camera.undistort({raw.cx, 0})->y(), 8);
  EXPECT_LE(camera.undistort({raw.cx, 479})->y(), camera.ideal().height - 0.5);
  EXPECT_LT(camera.undistort({0, raw.cy})->x(), -8) << "the outermost of 122 degrees is left out";
  for (int y = 0; y < raw.height; y += 40) {
    for (int x = 0; x < raw.width; x += 40) {
      const auto ideal = camera.undistort({x, y});
      ASSERT_TRUE(ideal);
      EXPECT_LT((*camera.distort(*ideal) - Eigen::Vector2d(x, y)).norm(), 1e-9);
    }
  }
}

TEST(Camera, RefusesARawPixelWhoseRayPointsBehind) {
  CameraIntrinsics raw = equidistant();
  raw.distortion = {0, 0, 0, 0};
  raw.fx = raw.fy = 150;  // 244 degrees from edge to edge
  const Camera camera(raw);
  EXPECT_TRUE(camera.model().unproject({0, raw.cy}));
  EXPECT_FALSE(camera.undistort({0, raw.cy}));
  EXPECT_TRUE(camera.undistort({160, raw.cy}));
}

}  // namespace
}  // namespace redbee::test
