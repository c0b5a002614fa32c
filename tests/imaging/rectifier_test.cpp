#include "redbee/imaging/rectifier.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace redbee::test {
namespace {

CameraIntrinsics fisheye() {
  return {640, 480, 305, 305, 319.5, 239.5, {-0.018, 0.0075, -0.0042, 0.0006}, "equidistant"};
}

TEST(Rectifier, PassesImagesOfAnIdealCameraThrough) {
  const Rectifier rectifier(Camera({64, 48, 50, 50, 31.5, 23.5, {}}));
  const cv::Mat image(48, 64, CV_8U, cv::Scalar(7));
  EXPECT_EQ(rectifier.toIdeal(image).data, image.data);
  EXPECT_EQ(rectifier.toRaw(image, 255).data, image.data);
  EXPECT_TRUE(rectifier.unknown().empty());
}

TEST(Rectifier, MarksWhatAWideLensShowsBeyondTheIdealImage) {
  const Camera camera(fisheye());
  const Rectifier rectifier(camera);
  const cv::Mat ideal = rectifier.toIdeal(cv::Mat(480, 640, CV_8U, cv::Scalar(90)));
  EXPECT_EQ(ideal.cols, camera.ideal().width);
  EXPECT_EQ(ideal.rows, camera.ideal().height);
  const cv::Mat known(ideal.size(), CV_8U, cv::Scalar(0)), moving(ideal.size(), CV_8U, cv::Scalar(255));
  const cv::Mat unknown = rectifier.toRaw(known, 255), mask = rectifier.toRaw(moving);
  EXPECT_EQ(unknown.size(), cv::Size(640, 480));
  EXPECT_EQ(unknown.at<uchar>(240, 320), 0);
  EXPECT_EQ(mask.at<uchar>(240, 320), 255);
  EXPECT_EQ(unknown.at<uchar>(240, 2), 255) << "beyond 105 degrees";
  EXPECT_EQ(mask.at<uchar>(240, 2), 0) << "and no foreground";
  EXPECT_EQ(cv::countNonZero(unknown == mask), 0);
}

TEST(Rectifier, MarksWhatTheRawImageDoesNotShow) {
  CameraIntrinsics pincushion{640, 480, 500, 500, 319.5, 239.5, {0.2, 0, 0, 0, 0}};
  const Rectifier rectifier{Camera(pincushion)};
  ASSERT_EQ(rectifier.unknown().size(), cv::Size(640, 480));
  EXPECT_EQ(rectifier.unknown().at<uchar>(0, 0), 255);
  EXPECT_EQ(rectifier.unknown().at<uchar>(240, 320), 0);
  const cv::Mat ideal = rectifier.toIdeal(cv::Mat(480, 640, CV_8U, cv::Scalar(90)));
  EXPECT_EQ(ideal.at<uchar>(0, 0), 0);
}

cv::Mat1b cornerOfParts() {
  cv::Mat1b parts(480, 640, uchar{0});
  parts(cv::Rect(0, 0, 200, 100)).setTo(255);
  return parts;
}

TEST(Rectifier, OwnPartsOfAnIdealCameraAreUnknown) {
  const cv::Mat1b parts = cornerOfParts();
  const Rectifier rectifier(Camera({640, 480, 500, 500, 319.5, 239.5, {}}), parts);
  EXPECT_EQ(cv::countNonZero(rectifier.unknown() != parts), 0);
  EXPECT_EQ(cv::countNonZero(rectifier.ownParts() != parts), 0);
}

TEST(Rectifier, OwnPartsOfALensAreUnknownBesideWhatItDoesNotShow) {
  CameraIntrinsics pincushion{640, 480, 500, 500, 319.5, 239.5, {0.2, 0, 0, 0, 0}};
  const Camera camera(pincushion);
  const Rectifier without(camera);
  const Rectifier rectifier(camera, cornerOfParts());
  EXPECT_EQ(cv::countNonZero(without.unknown() & ~rectifier.unknown()), 0) << "nothing becomes known";
  for (const Eigen::Vector2d& raw : {Eigen::Vector2d(100, 50), Eigen::Vector2d(190, 90)}) {
    const auto ideal = camera.undistort(raw);
    ASSERT_TRUE(ideal);
    EXPECT_EQ(rectifier.ownParts()(cvRound(ideal->y()), cvRound(ideal->x())), 255);
  }
  const auto beside = camera.undistort({230, 120});
  ASSERT_TRUE(beside);
  EXPECT_EQ(rectifier.unknown()(cvRound(beside->y()), cvRound(beside->x())), 0);
}

TEST(Rectifier, OwnPartsOfAnotherSizeAreRefused) {
  const Camera camera({64, 48, 50, 50, 31.5, 23.5, {}});
  EXPECT_THROW(Rectifier(camera, cornerOfParts()), std::invalid_argument);
}

/// The mean of what rounding leaves is 0.
TEST(Rectifier, MapsComeBackWithoutAShift) {
  const Camera camera({640, 480, 500, 500, 319.5, 239.5, {-0.25, 0.06, 0, 0, 0}});
  cv::Mat1b columns(480, 640);
  for (int u = 0; u < 640; ++u) columns.col(u).setTo(u % 200);
  const cv::Mat1b raw = Rectifier(camera).toRaw(columns);
  double sum = 0;
  int count = 0;
  for (int v = 100; v < 380; v += 3) {
    for (int u = 210; u < 390; ++u, ++count) sum += raw(v, u) - (camera.undistort({u, v})->x() - 200);
  }
  EXPECT_NEAR(sum / count, 0, 0.05);
}

/// As a camera of that focal length, and its ideal camera, would be.
void expectAsZoomed(const CameraIntrinsics& intrinsics, double zoom) {
  const Camera camera(intrinsics), lens = zoomed(camera, zoom);
  const Rectifier rectifier(camera, cornerOfParts()), truth(lens);
  cv::Mat1b image(480, 640);
  for (int v = 0; v < 480; ++v)
    for (int u = 0; u < 640; ++u)
      image(v, u) = static_cast<uchar>(128 + 60 * std::sin(u / 9.0) + 60 * std::cos(v / 7.0));
  const Exposure exposure{std::nullopt, zoom};
  const cv::Mat1b ideal = rectifier.toIdeal(image, exposure), expected = truth.toIdeal(image);
  ASSERT_EQ(ideal.size(), expected.size());
  cv::Mat1b known = rectifier.ownParts(exposure) == 0;
  if (!truth.unknown().empty()) {
    EXPECT_LT(cv::countNonZero(truth.unknown() & known), 100) << "of a border of 2000 px, 1/32 px is rounded";
  }
  cv::Mat1b difference;
  cv::absdiff(ideal, expected, difference);
  EXPECT_LT(cv::mean(difference, known)[0], 0.5) << zoom;
  EXPECT_GT(cv::mean(rectifier.toIdeal(image) != expected, known)[0], 100) << "the zoom shows";
  cv::absdiff(rectifier.toRaw(expected, 0, exposure), truth.toRaw(expected, 0), difference);
  EXPECT_LT(cv::mean(difference)[0], 0.5) << "pixels have the same nearest neighbours but for a few";
}

TEST(Rectifier, ALensThatZoomsIsRectifiedAtItsFocalLength) {
  for (const double zoom : {0.8, 1.3, 2.0})
    expectAsZoomed({640, 480, 500, 500, 319.5, 239.5, {-0.25, 0.06, 0, 0, 0}}, zoom);
  for (const double zoom : {1.3, 2.0}) expectAsZoomed(fisheye(), zoom);
}

/// A frame and the one before, or a lens with and without the rows' motion, are asked for in turns.
TEST(Rectifier, TwoExposuresInTurnsAreEachTabulatedOnce) {
  const Camera camera({640, 480, 500, 500, 319.5, 239.5, {-0.25, 0.06, 0, 0, 0}});
  const Rectifier rectifier(camera, cornerOfParts());
  const Exposure wide{std::nullopt, 1.2}, narrow{std::nullopt, 1.5};
  const cv::Mat1b wide_parts = rectifier.ownParts(wide), narrow_parts = rectifier.ownParts(narrow);
  for (int turn = 0; turn < 3; ++turn) {
    EXPECT_EQ(rectifier.ownParts(wide).data, wide_parts.data);
    EXPECT_EQ(rectifier.ownParts(narrow).data, narrow_parts.data);
  }
  EXPECT_GT(cv::countNonZero(wide_parts != narrow_parts), 0);
}

TEST(Rectifier, OwnPartsGrowWithTheFocalLength) {
  const Rectifier rectifier(Camera({640, 480, 500, 500, 319.5, 239.5, {}}), cornerOfParts());
  const cv::Mat1b parts = rectifier.ownParts({std::nullopt, 2});
  EXPECT_EQ(cv::countNonZero(rectifier.unknown(2) != parts), 0);
  EXPECT_EQ(parts(0, 78), 0) << "(200 - 319.5) * 2 + 319.5 = 80.5 is its edge, but 100 lies above the image";
  const cv::Mat1b wide = rectifier.ownParts({std::nullopt, 0.5});
  EXPECT_EQ(wide(160, 250), 255) << "its corner lies at (259.75, 169.75)";
  EXPECT_EQ(wide(160, 270), 0);
  EXPECT_EQ(wide(20, 20), 255) << "and goes on beyond what the mask shows";
}

}  // namespace
}  // namespace redbee::test
