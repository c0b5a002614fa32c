// Ground truth as public data sets have it.
#include "processes/redbee/evaluate/truth_masks.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <opencv2/imgcodecs.hpp>

#include "processes/redbee/evaluate/clip_truth.hpp"
#include "processes/redbee/evaluate/evaluate.hpp"
#include "redbee/files/input_error.hpp"
#include "tests/support/gpmf_bytes.hpp"
#include "tests/support/log_events.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/shared_flight.hpp"

namespace redbee::test {
namespace {

const cv::Size kSize(32, 24);
const cv::Rect kBox(4, 6, 8, 5);
const std::vector<int64_t> kUtimes = {0, 40'000, 80'000, 120'000};

cv::Mat1b labelled(int inside, int outside = 0) {
  cv::Mat1b mask(kSize, static_cast<uint8_t>(outside));
  mask(kBox).setTo(inside);
  return mask;
}

void write(const fs::path& file, const cv::Mat& image) {
  fs::create_directories(file.parent_path());
  ASSERT_TRUE(cv::imwrite(file.string(), image));
}

void appendChunk(Bytes& png, const std::string& type, const Bytes& data) {
  append(png, bigEndian(data.size(), 4));
  Bytes typed(type.begin(), type.end());
  append(typed, data);
  append(png, typed);
  append(png, bigEndian(crc32(0, typed.data(), static_cast<uInt>(typed.size())), 4));
}

/// A PNG of indices with a palette: OpenCV writes none.
void writePalette(const fs::path& file, const cv::Mat1b& indices, const Bytes& palette) {
  Bytes png{0x89, 'P', 'N', 'G', 13, 10, 26, 10};
  Bytes header = bigEndian(static_cast<uint64_t>(indices.cols), 4);
  append(header, bigEndian(static_cast<uint64_t>(indices.rows), 4));
  append(header, {8, 3, 0, 0, 0});  // 8 bits, indexed
  appendChunk(png, "IHDR", header);
  appendChunk(png, "PLTE", palette);
  Bytes rows;
  for (int y = 0; y < indices.rows; ++y) {
    rows.push_back(0);
    rows.insert(rows.end(), indices.ptr(y), indices.ptr(y) + indices.cols);
  }
  uLongf size = compressBound(rows.size());
  Bytes packed(size);
  compress(packed.data(), &size, rows.data(), rows.size());
  packed.resize(size);
  appendChunk(png, "IDAT", packed);
  appendChunk(png, "IEND", {});
  writeText(file, {png.begin(), png.end()});
}

class TruthMasksTest : public testing::Test {
 protected:
  fs::path truth() const { return folder_ / "truth"; }
  /// The mask of the first labelled frame.
  cv::Mat1b firstMask() const {
    const ClipTruth clip(truth());
    return clip.read(clip.frames(kUtimes).at(0), kSize).mask;
  }
  std::string refusal() const {
    return errorMessageOf([&] { firstMask(); });
  }
  ScratchFolder folder_;
};

TEST_F(TruthMasksTest, ColoursOfAPaletteAreObjects) {
  // VOC's palette begins with black and dark red, which as grey is 38 and was taken for unknown.
  writePalette(truth() / "00000.png", labelled(1), {0, 0, 0, 128, 0, 0});
  EXPECT_EQ(cv::norm(firstMask(), labelled(255), cv::NORM_INF), 0);
  writePalette(truth() / "00000.png", labelled(2), {0, 0, 0, 128, 0, 0, 224, 224, 192});
  EXPECT_EQ(firstMask()(kBox.y, kBox.x), 128) << "VOC's colour of the undecided";
  // A palette of greys is a grey mask.
  writePalette(truth() / "00000.png", labelled(1), {0, 0, 0, 255, 255, 255});
  EXPECT_EQ(cv::norm(firstMask(), labelled(255), cv::NORM_INF), 0);
}

TEST_F(TruthMasksTest, OneMovesWhereNothingIsHigher) {
  write(truth() / "00000.png", labelled(0));
  write(truth() / "00001.png", labelled(1));
  const ClipTruth clip(truth());
  EXPECT_EQ(cv::norm(clip.read(clip.frames(kUtimes).at(1), kSize).mask, labelled(255), cv::NORM_INF), 0);
}

TEST_F(TruthMasksTest, JpegMasksAreReadAndImagesRefused) {
  write(truth() / "00000.jpg", labelled(255));
  const cv::Mat1b mask = firstMask();
  EXPECT_EQ(mask(kBox.y + 2, kBox.x + 3), 255);
  EXPECT_EQ(mask(0, 31), 0);
  write(truth() / "00000.jpg", texture(kSize.width, kSize.height, 0, 3));
  EXPECT_NE(refusal().find("00000.jpg: is an image, not a mask"), std::string::npos) << refusal();
}

TEST_F(TruthMasksTest, ObjectNumbersInGreyAreRefused) {
  write(truth() / "00000.png", labelled(0));
  write(truth() / "00001.png", labelled(2));
  EXPECT_NE(refusal().find("00001.png: holds the value 2, and no mask of the clip holds 255"),
            std::string::npos)
      << refusal();
}

TEST_F(TruthMasksTest, CdnetsGreysAndFolderAreRead) {
  cv::Mat1b mask = labelled(255, 85);
  mask(0, 0) = 170;
  mask(0, 1) = 50;
  mask(0, 2) = 0;
  for (int k = 1; k <= 4; ++k)
    write(truth() / "groundtruth" / ("gt00000" + std::to_string(k) + ".png"), mask);
  const ClipTruth clip(truth());
  const auto frames = clip.frames(kUtimes);
  ASSERT_EQ(frames.size(), 4u);
  EXPECT_EQ(frames[0].utime, 0) << "CDnet counts from 1";
  EXPECT_EQ(frames[3].index, 3);
  EXPECT_EQ(cv::norm(clip.read(frames[0], kSize).mask, mask, cv::NORM_INF), 0);
}

TEST_F(TruthMasksTest, CdnetsNumbersCountFromOneAlsoWhereSomeAreMissing) {
  write(truth() / "groundtruth" / "gt000002.png", labelled(255));
  EXPECT_EQ(ClipTruth(truth()).frames(kUtimes).at(0).utime, 40'000);
}

TEST_F(TruthMasksTest, NumbersThatReachTheFrameCountWithoutZeroCountFromOne) {
  for (int k = 1; k <= 4; ++k)
    write(truth() / "Annotations" / ("0000" + std::to_string(k) + ".png"), labelled(255));
  const auto frames = ClipTruth(truth()).frames(kUtimes);
  ASSERT_EQ(frames.size(), 4u);
  EXPECT_EQ(frames[0].utime, 0);
  EXPECT_EQ(frames[3].utime, 120'000);
}

TEST_F(TruthMasksTest, MotsBoxesAreReadFromOne) {
  writeText(truth() / "gt" / "gt.txt",
            "1,1,3,3,8,6,1,1,1.0\n2,1,5,3,8,6,1,1,0.9\n2,2,20,3,8,6,0,1,1\n2,3,20,13,8,6,1,7,1\n");
  const ClipTruth clip(truth());
  const auto frames = clip.frames(kUtimes);
  ASSERT_EQ(frames.size(), 4u);
  const auto objects = clip.read(frames[1], kSize).objects.objects;
  ASSERT_EQ(objects.size(), 3u);
  EXPECT_EQ(objects[0].box, cv::Rect2d(4, 2, 8, 6));
  EXPECT_TRUE(objects[0].counts);
  EXPECT_FALSE(objects[1].counts) << "flag 0";
  EXPECT_FALSE(objects[2].counts) << "a static person";
  writeText(truth() / "gt" / "gt.txt", "0,1,3,3,8,6,1,1,1.0\n");
  EXPECT_NE(refusal().find("gt.txt:1: frame 0: MOT counts frames from 1"), std::string::npos) << refusal();
}

/// It was printed as an error of 1.
TEST_F(TruthMasksTest, BoxesAloneDefineNoMeasureOfPixels) {
  for (const int64_t utime : kUtimes) {
    for (const char* kind : {"probability", "mask"})
      write(folder_ / "run" / kind / (std::to_string(utime) + ".png"), labelled(255));
  }
  writeText(truth() / "gt" / "gt.txt", "1,1,5,7,8,5,1,1,1.0\n");
  testing::internal::CaptureStdout();
  runEvaluate({truth(), folder_ / "run", {}});
  const std::string printed = testing::internal::GetCapturedStdout();
  EXPECT_NE(printed.find("run"), std::string::npos) << printed;
  EXPECT_EQ(printed.find("1.000"), std::string::npos) << printed;
}

TEST_F(TruthMasksTest, FramesBeyondTheAskedOnesAreNotMissed) {
  for (const int64_t utime : kUtimes) {
    for (const char* kind : {"probability", "mask"})
      write(folder_ / "run" / kind / (std::to_string(utime) + ".png"), labelled(255));
    write(truth() / "mask" / (std::to_string(1000 * utime) + ".png"), labelled(255));
  }
  for (const char* later : {"160000000", "200000000"})
    write(truth() / "mask" / (std::string(later) + ".png"), labelled(255));
  EvaluateOptions options{truth(), folder_ / "run", {}};
  EXPECT_EQ(measureClip(options).truth_without_result, 2);
  options.frames = 4;  // as many as the recording has
  EXPECT_EQ(measureClip(options).truth_without_result, 0);
  EXPECT_EQ(measureClip(options).pixels.frames(), 4);
  options.frames = 2;
  EXPECT_EQ(measureClip(options).pixels.frames(), 2);
}

TEST_F(TruthMasksTest, RecordedPalette) {
  const auto folder = sharedCase("truth_davis_palette");
  if (!folder) GTEST_SKIP() << "the cases are not here (REDBEE_SHARED)";
  const ClipTruth clip(*folder);
  const auto frames = clip.frames(kUtimes);
  ASSERT_EQ(frames.size(), 2u);
  const cv::Size size = cv::imread(frames[0].mask.string()).size();
  for (const auto& frame : frames) EXPECT_GT(cv::countNonZero(clip.read(frame, size).mask == 255), 0);
}

}  // namespace
}  // namespace redbee::test
