#include "redbee/imaging/rectifier.hpp"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace redbee::test
