// redbee try, on a recording that only needs its folder.
#include <gtest/gtest.h>

#include <array>
#include <opencv2/imgcodecs.hpp>

#include "processes/redbee/commands/command.hpp"
#include "processes/redbee/evaluate/simulate_flight.hpp"
#include "redbee/bus/image.hpp"
#include "redbee/importers/recognise.hpp"
#include "tests/support/gpmf_bytes.hpp"
#include "tests/support/log_events.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/test_video.hpp"

namespace redbee::test {
namespace {

int run(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "redbee");
  std::vector<char*> argv;
  argv.reserve(arguments.size());
  for (std::string& argument : arguments) argv.push_back(argument.data());
  return runTool(static_cast<int>(argv.size()), argv.data());
}

TEST(TryCommand, RecordingsAreRecognisedByTheirContent) {
  const ScratchFolder folder;
  TestVideo video;
  video.image = numbered;
  video.frames = 3;
  writeTestVideo(folder / "v.mp4", video);
  video.track = packets(1);
  writeTestVideo(folder / "g.mp4", video);
  LogWriter log(folder / "l.bin");
  log.write(1, "X", {1});
  log.close();
  fs::create_directories(folder / "flight" / "mav0");
  EXPECT_EQ(recogniseRecording(folder / "v.mp4"), "video");
  EXPECT_EQ(recogniseRecording(folder / "g.mp4"), "gopro");
  EXPECT_EQ(recogniseRecording(folder / "l.bin"), "");
  EXPECT_EQ(recogniseRecording(folder / "flight"), "asl");
  writeText(folder / "b.bin", "#ROSBAG V2.0\n");
  EXPECT_EQ(recogniseRecording(folder / "b.bin"), "rosbag");
  writeText(folder / "m.bin", "\x89MCAP0\r\n");
  EXPECT_EQ(recogniseRecording(folder / "m.bin"), "mcap");
  EXPECT_EQ(recogniseRecording(folder.path()), "video");
  EXPECT_NE(errorMessageOf([&] { recogniseRecording(folder / "none"); }).find("no such file or folder"),
            std::string::npos);
}

TEST(TryCommand, AFolderOfImagesAndALogLeaveOverlayAndReport) {
  const ScratchFolder folder;
  SimulateOptions simulate;
  simulate.scenario = "walkers";
  simulate.seconds = 1;
  simulate.log = folder / "sim.lcm";
  runSimulate(simulate);
  fs::create_directories(folder / "images");
  int number = 0;
  for (const image_t& image : messagesOn<image_t>(readEvents(simulate.log), "CAMERA"))
    cv::imwrite((folder / "images").string() + "/" + std::to_string(number++) + ".png", *decodeGrey(image));
  EXPECT_EQ(run({"try", (folder / "images").string(), "--fps", "24", "--out", (folder / "a").string()}), 0);
  EXPECT_EQ(run({"try", simulate.log.string(), "--out", (folder / "b").string()}), 0);
  for (const char* out : {"a", "b"}) {
    for (const char* file : {"overlay.mp4", "report.html", "detections.csv"})
      EXPECT_TRUE(fs::exists(folder / out / file)) << out << file;
  }
  EXPECT_TRUE(fs::exists(folder / "a" / "flight.yaml"));
  EXPECT_EQ(run({"try", (folder / "images").string(), "--out", (folder / "c").string()}), 2)
      << "no frame rate";
}

/// What a command prints to stderr.
std::string complaintOf(const std::vector<std::string>& arguments) {
  testing::internal::CaptureStderr();
  EXPECT_EQ(run(arguments), 2);
  return testing::internal::GetCapturedStderr();
}

TEST(TryCommand, WhatIsRefusedLeavesNoFolder) {
  const ScratchFolder folder;
  TestVideo video;
  video.image = numbered;
  video.frames = 3;
  writeTestVideo(folder / "v.mp4", video);
  const std::string source = (folder / "v.mp4").string(), out = (folder / "a" / "b").string();
  const std::string none = (folder / "none.yaml").string();
  EXPECT_NE(complaintOf({"try", source, "--config", none, "--out", out}).find(none), std::string::npos);
  writeText(folder / "bad.yaml", "camera: {width: many}\n");
  EXPECT_NE(complaintOf({"try", source, "--config", (folder / "bad.yaml").string(), "--out", out})
                .find("bad.yaml:1"),
            std::string::npos);
  writeText(folder / "text.mp4", "no video");
  complaintOf({"try", (folder / "text.mp4").string(), "--out", out});
  EXPECT_FALSE(fs::exists(folder / "a"));
  fs::create_directories(folder / "kept");
  complaintOf({"try", (folder / "text.mp4").string(), "--out", (folder / "kept").string()});
  EXPECT_TRUE(fs::exists(folder / "kept")) << "it was there before";
}

TEST(TryCommand, AnAddressIsNoFile) {
  for (const char* address : {"rtsp://10.0.0.1/live", "http://h/v.mp4", "udp://@:5600"}) {
    EXPECT_NE(complaintOf({"try", address}).find("is an address, not a file: record it first"),
              std::string::npos);
    EXPECT_NE(complaintOf({"import", "video", address, "--out", "/nowhere.lcm"}).find("is an address"),
              std::string::npos);
  }
}

TEST(TryCommand, WhatMessagesOfImportersNameIsTaken) {
  const ScratchFolder folder;
  TestVideo video;
  video.image = numbered;
  video.frames = 30;
  writeTestVideo(folder / "v.mp4", video);
  const std::string source = (folder / "v.mp4").string(), out = (folder / "o").string();
  std::string rows = "t_s,gx,gy,gz,ax,ay,az\n";
  for (int k = 0; k < 150; ++k)
    rows += std::to_string(0.01 * k) + ",0.0" + std::to_string(k % 3) + ",0.0" + std::to_string(k % 5) +
            ",0.0" + std::to_string(k % 7) + ",0.0" + std::to_string(k % 4) + ",0.0" + std::to_string(k % 6) +
            ",1.0" + std::to_string(k % 2) + "\n";
  writeText(folder / "imu.csv", rows);
  const std::string imu = (folder / "imu.csv").string();
  EXPECT_NE(complaintOf({"try", source, "--imu", imu, "--out", out}).find("--accel-unit g"),
            std::string::npos);
  const std::string later =
      complaintOf({"try", source, "--imu", imu, "--accel-unit", "g", "--keep-going", "--out", out});
  EXPECT_EQ(later.find("--accel-unit"), std::string::npos) << later;  // it comes as far as the detection
  EXPECT_TRUE(fs::exists(folder / "o" / "flight.lcm"));
  EXPECT_NE(complaintOf({"try", source, "--image-topic", "/a", "--out", out})
                .find("import video takes no --image-topic"),
            std::string::npos);
}

}  // namespace
}  // namespace redbee::test
