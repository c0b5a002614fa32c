// Videos that lack what most have: presentation times, an upright picture, an undamaged middle.
#include "redbee/importers/video_reader.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "tests/support/log_events.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/shared_flight.hpp"
#include "tests/support/test_video.hpp"

namespace redbee::test {
namespace {

std::vector<VideoFrame> readAll(VideoReader& reader) {
  std::vector<VideoFrame> frames;
  while (auto frame = reader.next()) frames.push_back(std::move(*frame));
  return frames;
}

std::vector<VideoFrame> readAll(const fs::path& file, VideoReaderOptions options = {}) {
  options.grey = true;
  VideoReader reader(file, options);
  return readAll(reader);
}

void expectInOrder(const std::vector<VideoFrame>& frames, int count, int64_t period_us) {
  ASSERT_EQ(frames.size(), static_cast<size_t>(count));
  for (int k = 0; k < count; ++k) {
    EXPECT_EQ(numberShownIn(frames[static_cast<size_t>(k)].image), k) << k;
    EXPECT_EQ(frames[static_cast<size_t>(k)].utime, k * period_us) << k;
  }
}

TestVideo numberedVideo() {
  TestVideo video;
  video.image = numbered;
  return video;
}

TEST(VideoReaderTest, AnAviWithBFramesComesInTheOrderOfDisplay) {
  for (const char* encoder : {"mpeg4", "libx264"}) {
    const ScratchFolder folder;
    TestVideo video = numberedVideo();
    video.container = "avi";
    video.encoder = encoder;
    video.b_frames = 2;
    writeTestVideo(folder / "v.avi", video);
    SCOPED_TRACE(encoder);
    expectInOrder(readAll(folder / "v.avi"), 30, 40'000);
  }
}

TEST(VideoReaderTest, ARawStreamNeedsItsRate) {
  const ScratchFolder folder;
  TestVideo video = numberedVideo();
  video.container = "h264";
  video.b_frames = 2;
  writeTestVideo(folder / "v.h264", video);
  EXPECT_NE(errorMessageOf([&] { readAll(folder / "v.h264"); }).find("give its frame rate with --fps"),
            std::string::npos);
  VideoReaderOptions options;
  options.fps = 20;
  expectInOrder(readAll(folder / "v.h264", options), 30, 50'000);
}

TEST(VideoReaderTest, ARateBesideTimesIsSaidToBeOfNoUse) {
  const ScratchFolder folder;
  writeTestVideo(folder / "v.mp4", numberedVideo());
  VideoReaderOptions options;
  options.fps = 20;
  options.grey = true;
  VideoReader reader(folder / "v.mp4", options);
  expectInOrder(readAll(reader), 30, 40'000);
  ASSERT_EQ(reader.warnings().size(), 1u);
  EXPECT_NE(reader.warnings()[0].find("--fps is not used"), std::string::npos);
}

TEST(VideoReaderTest, ARotationThatTheContainerStatesIsApplied) {
  const auto board = [](int) { return numbered(9); };
  for (const int rotation : {0, 90, 180, 270}) {
    const ScratchFolder folder;
    TestVideo video;
    video.frames = 3;
    video.rotation_deg = rotation;
    video.image = board;
    writeTestVideo(folder / "v.mp4", video);
    VideoReaderOptions options;
    options.grey = true;
    VideoReader reader(folder / "v.mp4", options);
    EXPECT_EQ(reader.rotation_deg(), rotation);
    const auto frames = readAll(reader);
    ASSERT_EQ(frames.size(), 3u) << rotation;
    cv::Mat expected = board(0);
    if (rotation != 0) cv::rotate(board(0), expected, rotation / 90 - 1);
    ASSERT_EQ(frames[0].image.size(), expected.size()) << rotation;
    const int different = cv::countNonZero((frames[0].image > 140) != (expected > 140));
    EXPECT_LT(different, 10) << "pixels, of the bright block's 96; turned by " << rotation;
    EXPECT_EQ(reader.warnings().empty(), rotation == 0);
  }
}

/// PAL's on a 4:3 screen: what digitisers of analog video make.
TEST(VideoReaderTest, PixelsThatAreNotSquareAreSaid) {
  const ScratchFolder folder;
  TestVideo video = numberedVideo();
  video.frames = 2;
  video.pixel_aspect = {16, 15};
  for (const int rotation : {0, 90}) {
    video.rotation_deg = rotation;
    writeTestVideo(folder / "v.mp4", video);
    VideoReader reader(folder / "v.mp4", {});
    EXPECT_DOUBLE_EQ(reader.pixelAspect(), rotation == 0 ? 16.0 / 15 : 15.0 / 16);
    EXPECT_NE(reader.warnings().back().find("not square: camera.fy is "), std::string::npos);
  }
}

/// Each image shows two moments: what moves, or is near, has combs.
TEST(VideoReaderTest, AnInterlacedVideoIsSaidToBeOne) {
  const ScratchFolder folder;
  TestVideo video = numberedVideo();
  video.encoder = "mpeg2video";
  for (const bool interlaced : {false, true}) {
    video.interlaced = interlaced;
    writeTestVideo(folder / "v.mp4", video);
    VideoReader reader(folder / "v.mp4", {});
    readAll(reader);
    const auto warnings = reader.warnings();
    ASSERT_EQ(warnings.size(), interlaced ? 1u : 0u);
    if (interlaced) {
      EXPECT_NE(warnings[0].find("is interlaced"), std::string::npos) << warnings[0];
    }
  }
}

/// As a camera with two lenses writes it.
TEST(VideoReaderTest, OfTwoVideosInAFileOneIsTakenAndSaid) {
  const ScratchFolder folder;
  TestVideo video = numberedVideo();
  video.twice = true;
  writeTestVideo(folder / "v.mp4", video);
  VideoReader reader(folder / "v.mp4", {});
  EXPECT_EQ(readAll(reader).size(), 30u);
  ASSERT_EQ(reader.warnings().size(), 1u);
  EXPECT_NE(reader.warnings()[0].find("holds 2 videos: number 1"), std::string::npos) << reader.warnings()[0];
}

TEST(VideoReaderTest, TheWidthIsThatOfTheTurnedImageAndNothingIsEnlarged) {
  const ScratchFolder folder;
  TestVideo video = numberedVideo();
  video.frames = 2;
  video.rotation_deg = 90;
  writeTestVideo(folder / "v.mp4", video);
  VideoReaderOptions options;
  options.width = 32;
  EXPECT_EQ(readAll(folder / "v.mp4", options)[0].image.size(), cv::Size(32, 48));
  options.width = 16000;
  EXPECT_EQ(readAll(folder / "v.mp4", options)[0].image.size(), cv::Size(64, 96));
}

TEST(VideoReaderTest, DamageInTheMiddleIsPassedOverOnDemand) {
  const ScratchFolder folder;
  TestVideo video = numberedVideo();
  video.key_every = 10;
  video.broken_packet = 13;
  writeTestVideo(folder / "v.mp4", video);
  EXPECT_NE(errorMessageOf([&] { readAll(folder / "v.mp4"); }).find("the last good one"), std::string::npos);
  VideoReaderOptions options;
  options.keep_going = true;
  options.grey = true;
  VideoReader reader(folder / "v.mp4", options);
  const auto frames = readAll(reader);
  std::vector<int> shown;
  for (const VideoFrame& frame : frames) {
    shown.push_back(numberShownIn(frame.image));
    EXPECT_EQ(frame.utime, 40'000 * shown.back());
  }
  std::vector<int> expected;
  for (int k = 0; k < 30; ++k) {
    if (k < 13 || k >= 20) expected.push_back(k);  // a key frame every ten
  }
  EXPECT_EQ(shown, expected);
  ASSERT_EQ(reader.warnings().size(), 1u);
  EXPECT_NE(reader.warnings()[0].find("7 frames are left out"), std::string::npos) << reader.warnings()[0];
}

TEST(VideoReaderTest, ACoverImageIsNotTheRecording) {
  const ScratchFolder folder;
  TestVideo video = numberedVideo();
  cv::imencode(".png", cv::Mat1b(192, 192, uint8_t{90}), video.cover);
  writeTestVideo(folder / "v.mp4", video);
  const auto frames = readAll(folder / "v.mp4");
  ASSERT_FALSE(frames.empty());
  EXPECT_EQ(frames[0].image.size(), cv::Size(96, 64));
  expectInOrder(frames, 30, 40'000);
}

TEST(VideoReaderTest, RecordedCasesComeInWhole) {
  const auto avi = sharedCase("xvid_bframes.avi");
  const auto raw = sharedCase("raw_annexb.h264");
  const auto broken = sharedCase("video_corrupt_middle.mp4");
  if (!avi || !raw || !broken) GTEST_SKIP() << "the cases are not here (REDBEE_SHARED)";
  EXPECT_EQ(readAll(*avi).size(), 24u);
  VideoReaderOptions options;
  options.fps = 25;
  EXPECT_EQ(readAll(*raw, options).size(), 24u);
  options.keep_going = true;
  EXPECT_EQ(readAll(*broken, options).size(), 21u);
}

}  // namespace
}  // namespace redbee::test
