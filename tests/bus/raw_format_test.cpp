#include "redbee/bus/raw_format.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "redbee/bus/image.hpp"

namespace redbee {
namespace {

/// A smooth colour image, so that what a format leaves out can be interpolated.
cv::Mat3b scene() {
  cv::Mat3b bgr(48, 64);
  for (int y = 0; y < bgr.rows; ++y) {
    for (int x = 0; x < bgr.cols; ++x)
      bgr(y, x) = {static_cast<uint8_t>(40 + 2 * x), static_cast<uint8_t>(200 - 3 * y),
                   static_cast<uint8_t>(60 + x + y)};
  }
  return bgr;
}

image_t messageOf(const cv::Mat& pixels, cv::Size size, int32_t pixelformat) {
  image_t message{};
  message.width = size.width;
  message.height = size.height;
  message.row_stride = static_cast<int32_t>(pixels.step);
  message.pixelformat = pixelformat;
  message.data.assign(pixels.datastart, pixels.dataend);
  message.size = static_cast<int32_t>(message.data.size());
  return message;
}

/// Grey levels, in mean, but for a border that a mosaic leaves out.
double difference(const cv::Mat& a, const cv::Mat& b) {
  const cv::Rect inside(2, 2, a.cols - 4, a.rows - 4);
  return cv::norm(a(inside), b(inside), cv::NORM_L1) /
         static_cast<double>(a(inside).total() * static_cast<size_t>(a.channels()));
}

void expectScene(const image_t& message, double tolerance) {
  cv::Mat1b grey;
  cv::cvtColor(scene(), grey, cv::COLOR_BGR2GRAY);
  const auto decoded = decodeGrey(message);
  const auto colour = decodeColour(message);
  ASSERT_TRUE(decoded) << faultOfImage(message);
  ASSERT_TRUE(colour);
  std::cout << formatName(message.pixelformat) << ": grey " << difference(*decoded, grey) << ", colour "
            << difference(*colour, scene()) << "\n";
  EXPECT_LT(difference(*decoded, grey), tolerance);
  EXPECT_LT(difference(*colour, scene()), tolerance);
  EXPECT_EQ(decodeGrey(message, 2)->size(), grey.size() / 2);
  EXPECT_EQ(faultOfImage(message), "");
}

/// Y of BT.601 with U and V, each of the full size.
std::array<cv::Mat1b, 3> planes() {
  cv::Mat yuv;
  cv::cvtColor(scene(), yuv, cv::COLOR_BGR2YUV_I420);
  cv::Mat1b y = yuv.rowRange(0, 48), u(48, 64), v(48, 64);
  const uint8_t* halves = yuv.ptr(48);
  for (int row = 0; row < 48; ++row) {
    for (int x = 0; x < 64; ++x) {
      u(row, x) = halves[(row / 2) * 32 + x / 2];
      v(row, x) = halves[24 * 32 + (row / 2) * 32 + x / 2];
    }
  }
  return {y, u, v};
}

TEST(RawFormat, PackedYuv) {
  const auto [y, u, v] = planes();
  for (const bool y_first : {true, false}) {
    cv::Mat2b packed(48, 64);
    for (int row = 0; row < 48; ++row) {
      for (int x = 0; x < 64; ++x) {
        const uint8_t chroma = x % 2 == 0 ? u(row, x) : v(row, x);
        packed(row, x) = y_first ? cv::Vec2b(y(row, x), chroma) : cv::Vec2b(chroma, y(row, x));
      }
    }
    expectScene(messageOf(packed, {64, 48}, y_first ? 1448695129 : 1498831189), 6);  // YUYV, UYVY
  }
}

TEST(RawFormat, PlanarYuv) {
  cv::Mat yuv;
  cv::cvtColor(scene(), yuv, cv::COLOR_BGR2YUV_I420);
  expectScene(messageOf(yuv, {64, 48}, 808596553), 6);
}

TEST(RawFormat, Alpha) {
  cv::Mat bgra, rgba;
  cv::cvtColor(scene(), bgra, cv::COLOR_BGR2BGRA);
  cv::cvtColor(scene(), rgba, cv::COLOR_BGR2RGBA);
  expectScene(messageOf(bgra, {64, 48}, 877807426), 0.5);
  expectScene(messageOf(rgba, {64, 48}, 876758866), 0.5);
}

TEST(RawFormat, BayerMosaicsByTheirFirstTwoRows) {
  const std::vector<std::pair<int32_t, const char*>> mosaics = {
      {825770306, "BGGR"}, {844650584, "GBRG"}, {861427800, "GRBG"}, {878205016, "RGGB"}};
  for (const auto& [number, colours] : mosaics) {
    cv::Mat1b mosaic(48, 64);
    for (int y = 0; y < 48; ++y) {
      for (int x = 0; x < 64; ++x) {
        const char colour = colours[2 * (y % 2) + x % 2];
        mosaic(y, x) = scene()(y, x)[colour == 'B' ? 0 : colour == 'G' ? 1 : 2];
      }
    }
    expectScene(messageOf(mosaic, {64, 48}, number), 3);
  }
}

TEST(RawFormat, SixteenBitsFillTheRange) {
  for (const bool big_endian : {false, true}) {
    cv::Mat2b bytes(48, 64);
    for (int y = 0; y < 48; ++y) {
      for (int x = 0; x < 64; ++x) {
        const int value = 7000 + 10 * x;  // as of an infrared camera of 14 bits
        const auto high = static_cast<uint8_t>(value >> 8), low = static_cast<uint8_t>(value & 255);
        bytes(y, x) = big_endian ? cv::Vec2b(high, low) : cv::Vec2b(low, high);
      }
    }
    const auto grey = decodeGrey(messageOf(bytes, {64, 48}, big_endian ? 357 : 909199180));
    ASSERT_TRUE(grey);
    for (int x = 0; x < 64; ++x) EXPECT_NEAR((*grey)(20, x), 255.0 * x / 63, 1) << x;
  }
}

TEST(RawFormat, WhatIsNotReadIsNamed) {
  const cv::Mat1b pixels(48, 64, uint8_t{7});
  EXPECT_NE(faultOfImage(messageOf(pixels, {64, 48}, 842221382))
                .find("pixel format 'FG32' is not read; those that are: MJPEG, GRAY"),
            std::string::npos)
      << faultOfImage(messageOf(pixels, {64, 48}, 842221382));
  EXPECT_EQ(faultOfImage(messageOf(pixels, {64, 48}, 1448695129)),
            "3072 bytes are no YUYV image of 64x48, row stride 64");
  EXPECT_FALSE(decodeGrey(messageOf(cv::Mat1b(48, 63), {63, 48}, 1448695129)));
  EXPECT_FALSE(decodeGrey(messageOf(cv::Mat1b(49, 64), {64, 49}, 808596553)));
}

TEST(RawFormat, AnOrientationOfAJpegIsNotApplied) {
  image_t message = jpegMessage(0, scene(), 95);
  const std::vector<uint8_t> exif{0xFF, 0xE1, 0, 34, 'E', 'x', 'i', 'f', 0, 0, 'M', 'M', 0, 42, 0, 0, 0, 8,
                                  0,    1,    1, 18, 0,   3,   0,   0,   0, 1, 0,   6,   0, 0,  0, 0, 0, 0};
  message.data.insert(message.data.begin() + 2, exif.begin(), exif.end());
  message.size = static_cast<int32_t>(message.data.size());
  const auto grey = decodeGrey(message);
  ASSERT_TRUE(grey);
  EXPECT_EQ(grey->size(), cv::Size(64, 48));
}

}  // namespace
}  // namespace redbee
