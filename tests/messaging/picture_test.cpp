#include "messaging/picture.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace redbee {
namespace {

cv::Mat ramp() {
  cv::Mat grey(48, 64, CV_8U);
  for (int v = 0; v < grey.rows; ++v) {
    for (int u = 0; u < grey.cols; ++u) grey.at<uint8_t>(v, u) = static_cast<uint8_t>(2 * u + v);
  }
  return grey;
}

TEST(Picture, RawGreyComesBackUnchanged) {
  const auto decoded = decodeGrey(rawGreyMessage(7, ramp()));
  ASSERT_TRUE(decoded);
  EXPECT_EQ(cv::norm(*decoded, ramp(), cv::NORM_INF), 0);
}

TEST(Picture, RowsMayBePadded) {
  image_t message = rawGreyMessage(7, ramp());
  cv::Mat padded(48, 80, CV_8U, cv::Scalar(1));
  ramp().copyTo(padded(cv::Rect(0, 0, 64, 48)));
  message.row_stride = 80;
  message.data.assign(padded.data, padded.data + padded.total());
  message.size = static_cast<int32_t>(message.data.size());
  const auto decoded = decodeGrey(message);
  ASSERT_TRUE(decoded);
  EXPECT_EQ(cv::norm(*decoded, ramp(), cv::NORM_INF), 0);
}

TEST(Picture, JpegComesBackNearly) {
  const auto decoded = decodeGrey(jpegMessage(7, ramp(), 95));
  ASSERT_TRUE(decoded);
  EXPECT_LT(cv::norm(*decoded, ramp(), cv::NORM_L1) / ramp().total(), 2.0);
}

TEST(Picture, LiesAboutTheSizeAreRefused) {
  const auto refused = [](image_t message, auto&& lie) {
    lie(message);
    return !decodeGrey(message) && !decodeColour(message);
  };
  const image_t raw = rawGreyMessage(7, ramp());
  const image_t jpeg = jpegMessage(7, ramp(), 90);
  EXPECT_TRUE(refused(raw, [](image_t& m) { m.height = 4800; }));
  EXPECT_TRUE(refused(raw, [](image_t& m) { m.width = -1; }));
  EXPECT_TRUE(refused(raw, [](image_t& m) { m.row_stride = 63; }));
  EXPECT_TRUE(refused(raw, [](image_t& m) { m.pixelformat = 42; }));
  EXPECT_TRUE(refused(raw, [](image_t& m) { m.size -= 1; }));
  EXPECT_TRUE(refused(jpeg, [](image_t& m) { m.width = 6400; }));
  EXPECT_TRUE(refused(jpeg, [](image_t& m) { m.data.assign(m.data.size(), 0); }));
}

TEST(Picture, HeaderOfAJpegTellsItsSize) {
  const image_t jpeg = jpegMessage(7, ramp(), 90);
  EXPECT_EQ(jpegSize(jpeg.data.data(), jpeg.data.size()), cv::Size(64, 48));
  for (size_t cut = 0; cut < 40; ++cut) EXPECT_FALSE(jpegSize(jpeg.data.data(), cut).has_value()) << cut;
}

}  // namespace
}  // namespace redbee
