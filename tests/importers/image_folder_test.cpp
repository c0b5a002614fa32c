// Folders of images as cameras and data sets have them: unpadded numbers, EXIF orientation, 16 bits.
#include "redbee/importers/image_folder.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "redbee/bus/image.hpp"
#include "redbee/files/natural_order.hpp"
#include "redbee/importers/import_video.hpp"
#include "tests/support/gpmf_bytes.hpp"
#include "tests/support/log_events.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/shared_flight.hpp"
#include "tests/support/test_video.hpp"

namespace redbee::test {
namespace {

class ImageFolderTest : public testing::Test {
 protected:
  ImageFolderTest() {
    options_.source = folder_ / "images";
    options_.log = folder_ / "f.lcm";
    options_.fps = 10;
    fs::create_directories(options_.source);
  }
  std::vector<cv::Mat1b> import() {
    Progress progress("importing", "frames", true);
    summary_ = importRecording(videoImporter(), options_, progress);
    std::vector<cv::Mat1b> images;
    for (const image_t& message : messagesOn<image_t>(readEvents(options_.log), "CAMERA")) {
      const auto grey = decodeGrey(message);
      EXPECT_TRUE(grey);
      images.push_back(grey.value_or(cv::Mat1b()));
    }
    return images;
  }
  ScratchFolder folder_;
  ImportOptions options_;
  ImportSummary summary_;
};

TEST(NaturalOrder, RunsOfDigitsAreNumbers) {
  const std::vector<std::string> sorted = {"",
                                           "a",
                                           "a1",
                                           "a01b",
                                           "a2",
                                           "a10",
                                           "a10b",
                                           "a11",
                                           "b",
                                           "f.lcm.99",
                                           "f.lcm.100",
                                           "f.lcm.101",
                                           "x00000000000000000000000000000002",
                                           "x10000000000000000000000000000000"};
  for (size_t i = 0; i < sorted.size(); ++i) {
    for (size_t j = 0; j < sorted.size(); ++j)
      EXPECT_EQ(isNaturallyBefore(sorted[i], sorted[j]), i < j) << sorted[i] << " " << sorted[j];
  }
}

TEST_F(ImageFolderTest, UnpaddedNumbersAreInNaturalOrder) {
  for (int k = 1; k <= 12; ++k)
    cv::imwrite((options_.source / ("frame" + std::to_string(k) + ".png")).string(), numbered(k));
  const auto images = import();
  ASSERT_EQ(images.size(), 12u);
  for (int k = 1; k <= 12; ++k) EXPECT_EQ(numberShownIn(images[static_cast<size_t>(k) - 1]), k);
}

/// As macOS leaves them on cards and shares.
TEST_F(ImageFolderTest, HiddenFilesAreNoImages) {
  for (int k = 1; k <= 3; ++k)
    cv::imwrite((options_.source / ("frame" + std::to_string(k) + ".png")).string(), numbered(k));
  writeText(options_.source / "._frame1.png", std::string("\0\5\26\7", 4));
  EXPECT_EQ(import().size(), 3u);
}

/// The JPEG with an EXIF segment that states this orientation.
std::string withOrientation(const cv::Mat& image, int orientation) {
  std::vector<uint8_t> jpeg;
  cv::imencode(".jpg", image, jpeg, {cv::IMWRITE_JPEG_QUALITY, 95});
  Bytes exif{'E', 'x', 'i', 'f',  0,    0, 'M', 'M', 0, 42, 0, 0, 0,
             8,   0,   1,   0x01, 0x12, 0, 3,   0,   0, 0,  1, 0, static_cast<uint8_t>(orientation),
             0,   0,   0,   0,    0,    0};
  Bytes segment{0xFF, 0xE1};
  append(segment, bigEndian(exif.size() + 2, 2));
  append(segment, exif);
  jpeg.insert(jpeg.begin() + 2, segment.begin(), segment.end());
  return {jpeg.begin(), jpeg.end()};
}

TEST_F(ImageFolderTest, TheOrientationOfExifIsApplied) {
  const cv::Mat stored = numbered(9);
  for (const auto& [orientation, code] : {std::pair{1, -1},
                                          {3, int{cv::ROTATE_180}},
                                          {6, int{cv::ROTATE_90_CLOCKWISE}},
                                          {8, int{cv::ROTATE_90_COUNTERCLOCKWISE}}}) {
    writeText(options_.source / "1.jpg", withOrientation(stored, orientation));
    cv::Mat expected = stored;
    if (code >= 0) cv::rotate(stored, expected, code);
    const auto images = import();
    ASSERT_EQ(images.size(), 1u);
    ASSERT_EQ(images[0].size(), expected.size()) << orientation;
    EXPECT_LT(cv::norm(images[0], expected, cv::NORM_L1) / static_cast<double>(expected.total()), 3)
        << orientation;
    EXPECT_EQ(summary_.vehicle.width, expected.cols);
    EXPECT_EQ(summary_.vehicle.intrinsics->cx, (expected.cols - 1) / 2.0);
    EXPECT_EQ(summary_.warnings.size(), code >= 0 ? 2u : 1u);  // beside the focal length
  }
}

TEST_F(ImageFolderTest, SixteenBitsAreScaledByTheRangeOfTheSequence) {
  // A camera of 14 bits that uses a part of its range, with a dead pixel; the second image is half as bright.
  cv::Mat ramp(100, 100, CV_16UC1);
  for (int y = 0; y < 100; ++y)
    for (int x = 0; x < 100; ++x) ramp.at<uint16_t>(y, x) = static_cast<uint16_t>(7000 + 10 * (x + y));
  cv::Mat dead = ramp.clone();
  dead.at<uint16_t>(3, 3) = 65535;
  cv::imwrite((options_.source / "1.png").string(), dead);
  cv::imwrite((options_.source / "2.png").string(), cv::Mat(7000 + (ramp - 7000) / 2));
  const auto images = import();
  ASSERT_EQ(images.size(), 2u);
  double darkest = 0, brightest = 0;
  cv::minMaxLoc(images[0], &darkest, &brightest);
  EXPECT_EQ(darkest, 0);
  EXPECT_EQ(brightest, 255);
  EXPECT_NEAR(images[0](50, 50), 127, 4);
  EXPECT_NEAR(images[1](50, 50), 64, 4) << "one scale for all, or brightness would flicker";
}

TEST_F(ImageFolderTest, AnAlphaChannelIsLeftOut) {
  cv::imwrite((options_.source / "1.png").string(), cv::Mat(20, 30, CV_8UC4, cv::Scalar(50, 50, 50, 255)));
  const auto images = import();
  ASSERT_EQ(images.size(), 1u);
  EXPECT_NEAR(images[0](5, 5), 50, 2);
}

TEST_F(ImageFolderTest, TheInputIsNotOverwritten) {
  TestVideo recording;
  recording.image = numbered;
  writeTestVideo(folder_ / "v.mp4", recording);
  options_.source = folder_ / "v.mp4";
  options_.log = folder_.path() / "." / "v.mp4";
  const std::string video = readText(options_.source);
  EXPECT_NE(errorMessageOf([&] { import(); }).find("is also the input"), std::string::npos);
  EXPECT_TRUE(readText(options_.source) == video);
  options_.log = folder_ / "v.yaml";
  EXPECT_NE(errorMessageOf([&] { import(); }).find("is the name of the vehicle's configuration"),
            std::string::npos);
}

TEST_F(ImageFolderTest, RecordedCases) {
  const auto exif = sharedCase("pictures_exif6");
  const auto png16 = sharedCase("png16.png");
  if (!exif || !png16) GTEST_SKIP() << "the cases are not here (REDBEE_SHARED)";
  fs::copy(*png16, options_.source / "1.png");
  double darkest = 0, brightest = 0;
  cv::minMaxLoc(import().at(0), &darkest, &brightest);
  EXPECT_EQ(darkest, 0);
  EXPECT_EQ(brightest, 255);
  options_.source = *exif;
  EXPECT_EQ(import().at(0).size(), cv::Size(120, 160));
}

/// A program has converted them, and left what it read.
TEST_F(ImageFolderTest, EachImageInTwoFormatsIsRefused) {
  for (const char* name : {"f1.png", "f1.jpg", "f2.png", "f2.jpg"})
    cv::imwrite((options_.source / name).string(), texture(96, 64, 1, 1));
  EXPECT_NE(errorMessageOf([&] { import(); }).find("f1.png: stands beside f1.jpg"), std::string::npos);
}

TEST_F(ImageFolderTest, WhatAFolderHoldsInsteadOfImagesIsSaid) {
  EXPECT_NE(errorMessageOf([&] { import(); }).find("holds no JPEG or PNG images"), std::string::npos);
  for (const char* name : {"a.tiff", "b.tiff", "c.txt", ".hidden.bmp"})
    writeText(options_.source / name, "x");
  EXPECT_NE(errorMessageOf([&] { import(); }).find("holds no JPEG or PNG images, but 2 .tiff: convert them"),
            std::string::npos)
      << errorMessageOf([&] { import(); });
}

}  // namespace
}  // namespace redbee::test
