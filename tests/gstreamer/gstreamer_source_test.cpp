// Images out of real pipelines: test patterns and files.
#include "processes/camera/gstreamer/gstreamer_source.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

#include "redbee/bus/image.hpp"
#include "redbee/files/user_error.hpp"
#include "redbee/node/host_clock.hpp"
#include "tests/support/scratch_folder.hpp"

namespace redbee::test {
namespace {

using testing::HasSubstr;

/// All images until the source ends.
std::vector<image_t> imagesOf(GstreamerSource& source) {
  EXPECT_EQ(source.open(), "");
  std::vector<image_t> images;
  for (int waits = 0; source.isOpen() && waits < 1000; ++waits) {
    if (auto image = source.next(std::chrono::milliseconds(20))) images.push_back(std::move(*image));
  }
  EXPECT_FALSE(source.isOpen());
  return images;
}
std::vector<uint8_t> bytesOf(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}
std::string pattern(const std::string& name, const std::string& format, int images = 10) {
  // 33 wide: GStreamer pads the rows of GRAY8 to 36 bytes, of RGB to 100.
  return "videotestsrc pattern=" + name + " num-buffers=" + std::to_string(images) +
         " ! video/x-raw,format=" + format +
         ",width=33,height=20,framerate=50/1 ! appsink sync=false drop=false";
}

TEST(GstreamerSource, RowsAreTakenOutOfTheirPadding) {
  GstreamerSource source(pattern("white", "GRAY8"));
  const auto images = imagesOf(source);
  ASSERT_FALSE(images.empty());
  for (const image_t& image : images) {
    EXPECT_EQ(image.width, 33);
    EXPECT_EQ(image.height, 20);
    EXPECT_EQ(image.row_stride, 33);
    EXPECT_EQ(image.size, 660);
    const auto grey = decodeGrey(image);
    ASSERT_TRUE(grey);
    EXPECT_EQ(cv::countNonZero(*grey >= 235), 660);
  }
  EXPECT_EQ(source.fault(), "the pipeline has ended");
}

TEST(GstreamerSource, ColoursAreInTheirOrder) {
  for (const char* format : {"RGB", "BGR"}) {
    GstreamerSource source(pattern("red", format, 1));
    const auto images = imagesOf(source);
    ASSERT_EQ(images.size(), 1U);
    const auto colour = decodeColour(images[0]);
    ASSERT_TRUE(colour);
    EXPECT_EQ((*colour)(10, 16), cv::Vec3b(0, 0, 255)) << format;
  }
}

TEST(GstreamerSource, JpegPassesThrough) {
  const ScratchFolder folder;
  const std::string file = (folder / "image.jpg").string();
  GstreamerSource encoder(
      "videotestsrc num-buffers=1 ! video/x-raw,width=64,height=48 ! jpegenc ! tee name=t t. ! queue ! "
      "filesink buffer-mode=unbuffered location=" +
      file + " t. ! queue ! appsink sync=false");
  const auto images = imagesOf(encoder);
  ASSERT_EQ(images.size(), 1U);
  EXPECT_EQ(images[0].pixelformat, image_t::MJPEG);
  EXPECT_EQ(declaredSize(images[0]), cv::Size(64, 48));
  // The file's own thread may still have it to write.
  for (int waits = 0; bytesOf(file).size() < images[0].data.size() && waits < 500; ++waits)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_EQ(images[0].data, bytesOf(file));
}

/// Frames of a live source at 50 Hz: times 20 ms apart as the pipeline made them, whenever they were fetched,
/// and of this computer's clock: later than the start and not later than their arrival.
TEST(GstreamerSource, TimesAreThoseOfCaptureOnOurClock) {
  GstreamerSource source(
      "videotestsrc is-live=true num-buffers=12 ! video/x-raw,format=GRAY8,width=32,height=16,framerate=50/1 "
      "! appsink");
  const int64_t begin_us = hostNanoseconds() / 1000;
  const auto images = imagesOf(source);
  const int64_t end_us = hostNanoseconds() / 1000;
  ASSERT_GE(images.size(), 2U);
  for (size_t i = 0; i < images.size(); ++i) {
    EXPECT_GE(images[i].utime, begin_us);
    EXPECT_LE(images[i].utime, end_us);
    if (i == 0) continue;
    const int64_t step_us = images[i].utime - images[i - 1].utime;
    EXPECT_LE(std::abs(step_us - (step_us + 10'000) / 20'000 * 20'000), 300) << step_us;
  }
}

TEST(GstreamerSource, BeginsAgainAfterItsEnd) {
  GstreamerSource source(pattern("ball", "GRAY8", 3));
  EXPECT_FALSE(imagesOf(source).empty());
  EXPECT_FALSE(imagesOf(source).empty());
}

/// At once, or while it plays.
void openUntilItFails(GstreamerSource& source) {
  if (!source.open().empty()) return;
  for (int waits = 0; source.isOpen() && waits < 1000; ++waits) source.next(std::chrono::milliseconds(20));
}

TEST(GstreamerSource, SaysWhatIsWrongAtRunTime) {
  GstreamerSource source("filesrc location=/nowhere.jpg ! jpegdec ! videoconvert ! appsink");
  openUntilItFails(source);
  EXPECT_FALSE(source.isOpen());
  EXPECT_THAT(source.fault(), HasSubstr("/nowhere.jpg"));
}

std::string faultAfterOpening(const std::string& location) {
  GstreamerSource source("rtspsrc location=" + location + " ! rtpjpegdepay ! appsink");
  openUntilItFails(source);
  return source.fault();
}

TEST(GstreamerSource, NoPasswordIsSaid) {
  for (const auto& [location, said] : std::vector<std::pair<std::string, std::string>>{
           {"rtsp://127.0.0.1:9/user=admin&password=secret&channel=1", "rtsp://127.0.0.1:9: "},
           {"rtsp://127.0.0.1:9/live?user=admin&password=secret", "rtsp://127.0.0.1:9/live: "},
           {"rtsp://pilot:se/cret@127.0.0.1:9/live", "rtsp://127.0.0.1:9/live: "},
           {"rtsp://pilot:secret?@127.0.0.1:9/live", "rtsp://...: "}}) {
    const std::string fault = faultAfterOpening(location);
    EXPECT_THAT(fault, HasSubstr("rtspsrc " + said)) << location;
    EXPECT_THAT(fault, testing::Not(testing::ContainsRegex("cret|admin"))) << location;
  }
}

/// What is said does not change while nothing else does: a fault is logged once, not with each attempt.
TEST(GstreamerSource, SaysTheSameOfTheSameFailure) {
  for (const auto& [pipeline, said] : std::vector<std::pair<std::string, std::string>>{
           {"v4l2src device=/dev/nowhere ! image/jpeg ! appsink",
            "v4l2src: Cannot identify device '/dev/nowhere'. system error: No such file or directory"},
           {"v4l2src device=/etc/hostname ! image/jpeg ! appsink",
            "v4l2src: This isn't a device '/etc/hostname'."},
           {"v4l2src device=/dev/null ! image/jpeg ! appsink",
            "v4l2src: Error getting capabilities for device '/dev/null': It isn't a v4l2 driver. Check if it "
            "is a v4l1 driver. system error: Inappropriate ioctl for device"},
           {"rtspsrc location=rtsp://me:secret@127.0.0.1:9/live ! rtpjpegdepay ! appsink",
            "rtspsrc rtsp://127.0.0.1:9/live: Could not open resource for reading and writing. Failed to "
            "connect."},
           {"videotestsrc is-live=true ! video/x-raw,format=I420 ! appsink",
            "videotestsrc: Internal data stream error. streaming stopped, reason not-negotiated (-4): no "
            "format in common; the appsink takes JPEG, GRAY8, RGB, BGR: ... ! videoconvert ! appsink"}}) {
    GstreamerSource source(pipeline);
    for (int attempt = 0; attempt < 2; ++attempt) {
      openUntilItFails(source);
      EXPECT_EQ(source.fault(), said);
    }
  }
}

void expectRefused(const std::string& pipeline, const std::string& reason) {
  try {
    const GstreamerSource source(pipeline);
    FAIL() << pipeline;
  } catch (const UserError& error) {
    EXPECT_THAT(error.what(), HasSubstr("capture.pipeline: "));
    EXPECT_THAT(error.what(), HasSubstr(reason));
    EXPECT_THAT(error.what(), testing::Not(HasSubstr("\n")));
  }
}

TEST(GstreamerSource, RefusesWhatIsNoPipelineWithOneAppsink) {
  expectRefused("videotestsrc ! nosuchelement ! appsink", "nosuchelement");
  expectRefused("filesrc location=f ! avdec_nosuchcodec ! appsink", "apt-get install gstreamer1.0-libav");
  expectRefused("videotestsrc ! fakesink", "must end in one appsink");
  expectRefused("videotestsrc ! appsink videotestsrc ! appsink", "must end in one appsink");
  expectRefused("videotestsrc ! ! appsink", "");
  expectRefused("appsink", "");
}

}  // namespace
}  // namespace redbee::test
