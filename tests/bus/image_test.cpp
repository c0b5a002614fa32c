#include "redbee/bus/image.hpp"

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

TEST(Image, RawGreyRoundTripIsExact) {
  const auto decoded = decodeGrey(rawGreyMessage(7, ramp()));
  ASSERT_TRUE(decoded);
  EXPECT_EQ(cv::norm(*decoded, ramp(), cv::NORM_INF), 0);
}

TEST(Image, RowsMayBePadded) {
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

TEST(Image, JpegRoundTripIsClose) {
  const auto decoded = decodeGrey(jpegMessage(7, ramp(), 95));
  ASSERT_TRUE(decoded);
  EXPECT_LT(cv::norm(*decoded, ramp(), cv::NORM_L1) / ramp().total(), 2.0);
}

TEST(Image, WrongSizesAreRefused) {
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

TEST(Image, AJpegThatIsCutShortIsRefused) {
  const image_t whole = jpegMessage(7, ramp(), 90);
  for (const size_t size : {whole.data.size() / 3, whole.data.size() / 2, whole.data.size() - 2}) {
    image_t cut = whole;
    cut.data.resize(size);
    cut.size = static_cast<int32_t>(size);
    EXPECT_FALSE(decodeGrey(cut)) << size << " of " << whole.data.size() << " bytes";
    EXPECT_FALSE(decodeColour(cut));
  }
  image_t padded = whole;
  padded.data.resize(whole.data.size() + 100);
  padded.size = static_cast<int32_t>(padded.data.size());
  EXPECT_TRUE(decodeGrey(padded)) << "cameras pad";
}

TEST(Image, SmallerOnesAreTheMeanOfBlocks) {
  // Smooth, so that JPEG's scaled decoding, which omits high frequencies, loses nothing.
  for (const int downscale : {2, 4}) {
    cv::Mat expected;
    cv::resize(ramp(), expected, ramp().size() / downscale, 0, 0, cv::INTER_AREA);
    const auto raw = decodeGrey(rawGreyMessage(7, ramp()), downscale);
    ASSERT_TRUE(raw);
    EXPECT_EQ(cv::norm(*raw, expected, cv::NORM_INF), 0);
    const image_t jpeg = jpegMessage(7, ramp(), 95);
    const auto grey = decodeGrey(jpeg, downscale);
    const auto colour = decodeColour(jpeg, downscale);
    ASSERT_TRUE(grey && colour);
    ASSERT_EQ(grey->size(), expected.size());
    EXPECT_LT(cv::norm(*grey, expected, cv::NORM_L1) / static_cast<double>(expected.total()), 2.0);
    cv::Mat of_colour;
    cv::cvtColor(*colour, of_colour, cv::COLOR_BGR2GRAY);
    ASSERT_EQ(of_colour.size(), expected.size());
    EXPECT_LT(cv::norm(of_colour, expected, cv::NORM_L1) / static_cast<double>(expected.total()), 2.0);
  }
}

TEST(Image, ASizeThatDoesNotDivideIsRefused) {
  EXPECT_FALSE(decodeGrey(rawGreyMessage(7, ramp()(cv::Rect(0, 0, 63, 48))), 2));
  EXPECT_FALSE(decodeGrey(rawGreyMessage(7, ramp()(cv::Rect(0, 0, 64, 46))), 4));
  EXPECT_FALSE(decodeGrey(rawGreyMessage(7, ramp()), 3));
}

TEST(Image, HeaderOfAJpegHasItsSize) {
  const image_t jpeg = jpegMessage(7, ramp(), 90);
  EXPECT_EQ(jpegSize(jpeg.data.data(), jpeg.data.size()), cv::Size(64, 48));
  for (size_t cut = 0; cut < 40; ++cut) EXPECT_FALSE(jpegSize(jpeg.data.data(), cut).has_value()) << cut;
}

}  // namespace
}  // namespace redbee
