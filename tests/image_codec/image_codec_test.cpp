// Our codecs against OpenCV's: the same pixels from the same bytes, and bytes that it reads as the same
// pixels.
#include "redbee/image_codec/image_codec.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

#include "redbee/image_codec/jpeg.hpp"
#include "redbee/image_codec/png.hpp"

namespace redbee {
namespace {

using Bytes = std::vector<uint8_t>;

/// Noise over colours that change slowly, with a sharp edge.
cv::Mat3b scene(int width, int height) {
  cv::Mat3b image(height, width);
  cv::RNG random(7);
  random.fill(image, cv::RNG::UNIFORM, 0, 60);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u)
      image(v, u) += cv::Vec3b(static_cast<uint8_t>(u * 190 / width), static_cast<uint8_t>(v * 190 / height),
                               u > width / 3 ? 150 : 20);
  }
  return image;
}

Bytes opencv(const std::string& suffix, const cv::Mat& image, const std::vector<int>& parameters = {}) {
  Bytes bytes;
  cv::imencode(suffix, image, bytes, parameters);
  return bytes;
}

double difference(const cv::Mat& a, const cv::Mat& b) {
  if (a.size() != b.size() || a.type() != b.type()) return 1e9;
  return cv::norm(a, b, cv::NORM_INF);
}

TEST(Jpeg, PixelsAreThoseOfOpenCv) {
  struct Case {
    int downscale, grey, colour;
  };
  const Case cases[] = {{1, cv::IMREAD_GRAYSCALE, cv::IMREAD_COLOR},
                        {2, cv::IMREAD_REDUCED_GRAYSCALE_2, cv::IMREAD_REDUCED_COLOR_2},
                        {4, cv::IMREAD_REDUCED_GRAYSCALE_4, cv::IMREAD_REDUCED_COLOR_4},
                        {8, cv::IMREAD_REDUCED_GRAYSCALE_8, cv::IMREAD_REDUCED_COLOR_8}};
  for (const cv::Size size : {cv::Size(128, 96), cv::Size(53, 37), cv::Size(1, 1)}) {
    cv::Mat grey;
    cv::cvtColor(scene(size.width, size.height), grey, cv::COLOR_BGR2GRAY);
    for (const cv::Mat& image : {cv::Mat(scene(size.width, size.height)), grey}) {
      for (const int progressive : {0, 1}) {
        const Bytes bytes =
            opencv(".jpg", image, {cv::IMWRITE_JPEG_QUALITY, 80, cv::IMWRITE_JPEG_PROGRESSIVE, progressive});
        for (const Case& c : cases) {
          EXPECT_EQ(difference(decodeJpeg(bytes, false, c.downscale), cv::imdecode(bytes, c.grey)), 0);
          EXPECT_EQ(difference(decodeJpeg(bytes, true, c.downscale), cv::imdecode(bytes, c.colour)), 0);
        }
        EXPECT_EQ(difference(decodeImage(bytes), cv::imdecode(bytes, cv::IMREAD_UNCHANGED)), 0);
      }
    }
  }
}

TEST(Jpeg, WhatIsWrittenIsWhatOpenCvWrites) {
  const cv::Mat3b image = scene(101, 64);
  cv::Mat grey;
  cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
  const cv::Mat part = image(cv::Rect(3, 5, 40, 30));  // whose rows are not one after the other
  for (const cv::Mat& original : {cv::Mat(image), grey, part}) {
    for (const int quality : {30, 80, 95, 100}) {
      const cv::Mat ours = cv::imdecode(encodeJpeg(original, quality), cv::IMREAD_UNCHANGED);
      const cv::Mat theirs =
          cv::imdecode(opencv(".jpg", original, {cv::IMWRITE_JPEG_QUALITY, quality}), cv::IMREAD_UNCHANGED);
      EXPECT_EQ(difference(ours, theirs), 0) << quality;
    }
  }
  EXPECT_THROW(encodeJpeg({}, 80), std::invalid_argument);
  EXPECT_THROW(encodeJpeg(cv::Mat1f(4, 4, 1.F), 80), std::invalid_argument);
}

/// The image with EXIF data that states an orientation.
Bytes oriented(const Bytes& jpeg, uint8_t orientation) {
  const Bytes exif = {0xFF, 0xE1, 0, 34, 'E', 'x', 'i', 'f', 0, 0, 'M', 'M',         0, 42, 0, 0, 0, 8,
                      0,    1,    1, 18, 0,   3,   0,   0,   0, 1, 0,   orientation, 0, 0,  0, 0, 0, 0};
  constexpr size_t kStart = 2;  // start of image
  Bytes bytes(jpeg.size() + exif.size());
  std::copy_n(jpeg.begin(), kStart, bytes.begin());
  std::copy(exif.begin(), exif.end(), bytes.begin() + kStart);
  std::copy(jpeg.begin() + kStart, jpeg.end(), bytes.begin() + kStart + static_cast<long>(exif.size()));
  return bytes;
}

TEST(Jpeg, OrientationIsAppliedAsOpenCvDoes) {
  const Bytes jpeg = opencv(".jpg", scene(48, 32));
  EXPECT_EQ(jpegOrientation(jpeg), 1);
  for (uint8_t orientation = 1; orientation <= 8; ++orientation) {
    const Bytes bytes = oriented(jpeg, orientation);
    ASSERT_EQ(jpegOrientation(bytes), orientation);
    const cv::Mat stored = decodeJpeg(bytes, true);
    EXPECT_EQ(difference(stored, decodeJpeg(jpeg, true)), 0);
    EXPECT_EQ(difference(upright(stored, orientation), cv::imdecode(bytes, cv::IMREAD_COLOR)), 0)
        << +orientation;
  }
  EXPECT_EQ(jpegOrientation(oriented(jpeg, 0)), 1);
  EXPECT_EQ(jpegOrientation(oriented(jpeg, 9)), 1);
  EXPECT_EQ(jpegOrientation({}), 1);
}

TEST(Png, PixelsAreThoseOfOpenCv) {
  const cv::Mat3b colour = scene(61, 40);
  cv::Mat grey;
  cv::cvtColor(colour, grey, cv::COLOR_BGR2GRAY);
  cv::Mat deep_grey;
  cv::Mat deep_colour;
  grey.convertTo(deep_grey, CV_16U, 257, 11);
  colour.convertTo(deep_colour, CV_16U, 250, 11);
  for (const cv::Mat& image : {cv::Mat(colour), grey, deep_grey, deep_colour}) {
    const Bytes bytes = opencv(".png", image);
    EXPECT_EQ(difference(decodePng(bytes), image), 0) << image.type();
    EXPECT_EQ(difference(decodeImage(bytes), image), 0);
  }
  EXPECT_EQ(difference(decodeGreyImage(opencv(".png", grey)), grey), 0);
  for (const cv::Mat& image : {deep_grey, deep_colour, cv::Mat(colour)}) {
    const Bytes bytes = opencv(".png", image);
    // libpng and OpenCV round the weights of the three colours otherwise.
    EXPECT_LE(difference(decodeGreyImage(bytes), cv::imdecode(bytes, cv::IMREAD_GRAYSCALE)), 1);
  }
  const cv::Mat transparent(20, 30, CV_8UC4, cv::Scalar(50, 60, 70, 128));
  EXPECT_EQ(
      difference(decodePng(opencv(".png", transparent)), cv::Mat(20, 30, CV_8UC3, cv::Scalar(50, 60, 70))),
      0);
  const cv::Mat mask = grey > 90;
  EXPECT_EQ(difference(decodePng(opencv(".png", mask, {cv::IMWRITE_PNG_BILEVEL, 1})), mask), 0);
}

TEST(Png, WhatIsWrittenIsReadByOpenCv) {
  const cv::Mat3b colour = scene(61, 40);
  cv::Mat grey;
  cv::cvtColor(colour, grey, cv::COLOR_BGR2GRAY);
  cv::Mat transparent;
  cv::cvtColor(colour, transparent, cv::COLOR_BGR2BGRA);
  cv::Mat(transparent(cv::Rect(5, 5, 20, 20))).setTo(cv::Scalar(1, 2, 3, 77));
  const cv::Mat part = grey(cv::Rect(3, 5, 40, 30));
  for (const cv::Mat& image : {cv::Mat(colour), grey, transparent, part})
    EXPECT_EQ(difference(cv::imdecode(encodePng(image), cv::IMREAD_UNCHANGED), image), 0) << image.type();
  for (const int width : {1, 7, 8, 9, 61}) {
    const cv::Mat1b mask = grey(cv::Rect(0, 0, width, 40)) > 90;
    const Bytes png = encodeBilevelPng(mask);
    EXPECT_EQ(difference(cv::imdecode(png, cv::IMREAD_GRAYSCALE), mask), 0) << width;
    EXPECT_EQ(difference(decodeGreyImage(png), mask), 0) << width;
  }
  EXPECT_THROW(encodePng({}), std::invalid_argument);
  EXPECT_THROW(encodePng(cv::Mat1f(4, 4, 1.F)), std::invalid_argument);
}

TEST(Png, AMapOfFewValuesIsNotLargerThanOpenCvs) {
  cv::Mat1b map(480, 854, uint8_t{0});
  cv::circle(map, {300, 200}, 90, cv::Scalar(200), cv::FILLED);
  EXPECT_LE(encodePng(map).size(), opencv(".png", map).size() + 32);
  EXPECT_LT(encodeBilevelPng(map).size(), encodePng(map).size());
}

TEST(ImageCodec, DamageIsNoImage) {
  const Bytes jpeg = opencv(".jpg", scene(64, 48));
  const Bytes png = opencv(".png", scene(64, 48));
  for (size_t size = 0; size < png.size(); size += 97)
    EXPECT_TRUE(decodeImage(Bytes(png.begin(), png.begin() + static_cast<long>(size))).empty()) << size;
  for (size_t size = 0; size < 100; ++size)
    EXPECT_TRUE(decodeImage(Bytes(jpeg.begin(), jpeg.begin() + static_cast<long>(size))).empty()) << size;
  Bytes wrong = png;
  wrong[png.size() / 2] = static_cast<uint8_t>(wrong[png.size() / 2] ^ 0x55U);
  EXPECT_TRUE(decodeImage(wrong).empty()) << "its checksum says so";
  EXPECT_TRUE(decodeImage({'B', 'M', 1, 2, 3, 4}).empty());
  EXPECT_TRUE(decodeGreyImage({}).empty());
}

TEST(ImageCodec, AnImageThatIsTooLargeIsRefusedBeforeItIsAllocated) {
  Bytes png = opencv(".png", scene(64, 48));
  png[16] = 0x7F;  // the width's highest byte
  EXPECT_TRUE(decodePng(png).empty());
  Bytes jpeg = opencv(".jpg", scene(64, 48));
  const Bytes start_of_frame = {0xFF, 0xC0};
  const auto at = std::search(jpeg.begin(), jpeg.end(), start_of_frame.begin(), start_of_frame.end());
  ASSERT_NE(at, jpeg.end());
  *(at + 5) = *(at + 7) = 0xFF;  // height and width above 65280
  EXPECT_TRUE(decodeJpeg(jpeg, false).empty());
}

}  // namespace
}  // namespace redbee
