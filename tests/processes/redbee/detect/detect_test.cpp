// The offline commands, one after the other, on a simulated flight.
#include "processes/redbee/detect/detect.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>

#include "processes/redbee/evaluate/evaluate.hpp"
#include "processes/redbee/evaluate/overlay_video.hpp"
#include "processes/redbee/evaluate/report.hpp"
#include "processes/redbee/evaluate/simulate_flight.hpp"
#include "redbee/files/input_error.hpp"
#include "redbee/files/log.hpp"
#include "redbee/image_t.hpp"

namespace redbee {
namespace {

namespace fs = std::filesystem;
constexpr int kFrames = 24;

class Commands : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = fs::temp_directory_path() / ("redbee-commands-" + std::to_string(::getpid()));
    fs::create_directories(folder_);
    SimulateOptions simulate;
    simulate.scenario = "walkers";
    simulate.seconds = 1;
    simulate.log = folder_ / "sim.lcm";
    simulate.truth = folder_ / "truth";
    runSimulate(simulate);
    options_.log = simulate.log;
    options_.configuration = folder_ / "sim.yaml";
    options_.out = folder_ / "results";
    options_.quiet = true;
    frames_ = runDetect(options_);
  }
  static void TearDownTestSuite() { fs::remove_all(folder_); }

  static std::string text(const fs::path& file) {
    std::ostringstream content;
    content << std::ifstream(file).rdbuf();
    return content.str();
  }

  static inline fs::path folder_;
  static inline DetectOptions options_;
  static inline int64_t frames_ = 0;
};

/// What the error of a run says; empty without one.
std::string refusalOf(const DetectOptions& options) {
  try {
    runDetect(options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST_F(Commands, DetectLeavesAMapAndAMaskForEveryFrame) {
  EXPECT_EQ(frames_, kFrames);
  for (const char* kind : {"probability", "mask"}) {
    const auto count = std::distance(fs::directory_iterator(options_.out / kind), fs::directory_iterator());
    EXPECT_EQ(count, kFrames) << kind;
  }
}

TEST_F(Commands, DetectLeavesTheTablesOfTheContract) {
  EXPECT_EQ(text(options_.out / "detections.csv")
                .rfind("frame,id,bb_left,bb_top,bb_width,bb_height,conf,x,y,z,utime,seen", 0),
            0u);
  const std::string homographies = text(options_.out / "homography.csv");
  EXPECT_EQ(std::count(homographies.begin(), homographies.end(), '\n'), kFrames + 1);
  const auto summary = nlohmann::json::parse(text(options_.out / "summary.json"));
  EXPECT_EQ(summary.at("frames"), kFrames);
  EXPECT_EQ(summary.at("lost"), 0);
  EXPECT_EQ(summary.at("stages").size(), 4u);
  EXPECT_GT(summary.at("fps").get<double>(), 0);
  EXPECT_GT(summary.at("peak_rss_bytes").get<double>(), 0);
}

TEST_F(Commands, ProcessorTimeAddsUpAndStaysBelowTheProcesss) {
  const auto summary = nlohmann::json::parse(text(options_.out / "summary.json"));
  double work = 0, publishing = 0;
  for (const auto& stage : summary.at("stages")) {
    EXPECT_GT(stage.at("cpu_ms_per_frame"), 0);
    work += stage.at("cpu_ms_per_frame").get<double>();
    publishing += stage.at("cpu_publishing_ms_per_frame").get<double>();
  }
  EXPECT_NEAR(summary.at("cpu_ms_per_frame"), work, 1e-9);
  EXPECT_NEAR(summary.at("cpu_publishing_ms_per_frame"), publishing, 1e-9);
  EXPECT_LT(work + publishing, summary.at("cpu_process_ms_per_frame").get<double>());
}

TEST_F(Commands, SettingsFromTheCommandLineReachTheStack) {
  DetectOptions options = options_;
  options.out = folder_ / "late";
  options.settings = {"detection.learning_frames=1000"};
  EXPECT_NE(refusalOf(options).find("none of 24 frames has a mask to trust"), std::string::npos)
      << refusalOf(options);
  const auto summary = nlohmann::json::parse(text(options.out / "summary.json"));
  EXPECT_EQ(summary.at("frames_good"), 0);
  options.settings = {"detection.no_such_key=1"};
  EXPECT_THROW(runDetect(options), ConfigurationError);
  options.settings = {"nonsense"};
  EXPECT_THROW(runDetect(options), ConfigurationError);
}

TEST_F(Commands, ARivalReplacesTheDetector) {
  for (const auto& [method, stages] : {std::pair<std::string, size_t>{"mcd", 1}, {"datmo", 4}}) {
    DetectOptions options = options_;
    options.method = method;
    options.out = folder_ / method;
    EXPECT_EQ(runDetect(options), kFrames);
    const auto summary = nlohmann::json::parse(text(options.out / "summary.json"));
    EXPECT_EQ(summary.at("stages").size(), stages)
        << method << ": detectors that need the camera's motion need more";
    EXPECT_EQ(summary.at("skipped").get<int>() + summary.at("lost").get<int>(), 0) << method;
    EXPECT_GE(summary.at("frames_good").get<int>(), kFrames - 2) << method;
    EXPECT_TRUE(summary.at("stages").contains("redbee-motion-segmentation"));
    EvaluateOptions truth;
    truth.truth = folder_ / "truth";
    truth.results = options.out;
    EXPECT_EQ(measureClip(truth).truth_without_result, 0);
  }
}

TEST_F(Commands, RefusesAnUnknownMethodAndListsTheKnownOnes) {
  DetectOptions options = options_;
  options.method = "nobody";
  try {
    runDetect(options);
    FAIL() << "an unknown method runs";
  } catch (const InputError& error) {
    const std::string message = error.what();
    for (const std::string& name : methodNames()) EXPECT_NE(message.find(name), std::string::npos) << name;
    EXPECT_EQ(message.find('\n'), std::string::npos);
  }
}

TEST_F(Commands, RemovesTheMapsOfAnEarlierRun) {
  DetectOptions options = options_;
  options.out = folder_ / "again";
  fs::create_directories(options.out / "mask");
  std::ofstream(options.out / "mask" / "7.png") << "stale";
  runDetect(options);
  EXPECT_FALSE(fs::exists(options.out / "mask" / "7.png"));
}

TEST_F(Commands, EvaluateMeasuresAgainstTheTruth) {
  const ClipMeasures clip = measureClip({folder_ / "truth", options_.out, {}});
  EXPECT_EQ(clip.pixels.frames(), kFrames);
  EXPECT_EQ(clip.truth_without_result, 0);
  EXPECT_GT(clip.pixels.movingPixels(), 0);
  EXPECT_THROW(measureClip({folder_ / "nowhere", options_.out, {}}), InputError);
}

TEST_F(Commands, OverlayAndReportAreWritten) {
  OverlayOptions overlay;
  overlay.log = options_.log;
  overlay.configuration = options_.configuration;
  overlay.results = options_.out;
  overlay.video = folder_ / "overlay.mp4";
  renderOverlay(overlay);
  EXPECT_GT(fs::file_size(overlay.video), 1000u);
  ReportOptions report{options_.log, options_.configuration, options_.out, folder_ / "truth",
                       folder_ / "report.html"};
  writeReport(report);
  const std::string page = text(report.page);
  EXPECT_NE(page.find("redbee-motion-segmentation"), std::string::npos);
  EXPECT_NE(page.find("data:image/jpeg;base64,"), std::string::npos);
  EXPECT_NE(page.find("Error@50%"), std::string::npos);
}

/// Such as an IMU that is not used, as its mounting is another.
TEST_F(Commands, TheReportSaysWhatAProcessReportsInTheEnd) {
  const fs::path results = folder_ / "doubted";
  fs::copy(options_.out, results, fs::copy_options::recursive);
  auto summary = nlohmann::json::parse(text(results / "summary.json"));
  auto& stage = summary.at("stages").at("redbee-imu-integration");
  stage["state"] = 2;
  stage["message"] = "IMU and camera disagree";
  std::ofstream(results / "summary.json") << summary;
  const fs::path page = folder_ / "doubted.html";
  writeReport({options_.log, options_.configuration, results, {}, page});
  EXPECT_NE(text(page).find("at the end, redbee-imu-integration: IMU and camera disagree"),
            std::string::npos);
}

TEST_F(Commands, ALogWithoutImagesIsRefused) {
  DetectOptions options = options_;
  options.log = folder_ / "empty.lcm";
  std::ofstream(options.log) << "";
  options.out = folder_ / "none";
  EXPECT_THROW(runDetect(options), InputError);
}

TEST_F(Commands, ALogOfAnotherCameraIsRefused) {
  DetectOptions options = options_;
  options.out = folder_ / "another";
  options.settings = {"camera.width=320", "camera.height=240"};
  EXPECT_EQ(
      refusalOf(options),
      options.log.string() +
          ": none of 24 images can be used: CAMERA: an image of 640x480 is ignored, configured are 320x240");
}

TEST_F(Commands, ALogOfBrokenImagesIsRefused) {
  DetectOptions options = options_;
  options.log = folder_ / "broken.lcm";
  LogWriter log(options.log);
  for (int k = 0; k < 3; ++k) {
    image_t image{};
    image.utime = 1'000'000 + 40'000 * k;
    image.width = 640;
    image.height = 480;
    image.pixelformat = image_t::GRAY;
    image.row_stride = 640;
    image.data = {1, 2, 3};
    image.size = 3;
    log.write("CAMERA", image);
  }
  log.close();
  options.out = folder_ / "broken";
  EXPECT_NE(refusalOf(options).find("none of 3 images can be used: 3 bytes are no GRAY image of 640x480"),
            std::string::npos)
      << refusalOf(options);
}

TEST_F(Commands, AnotherTypeOfMessageOnTheChannelIsNamed) {
  DetectOptions options = options_;
  options.settings = {"channels.camera=IMU", "channels.imu=CAMERA"};
  options.out = folder_ / "type";
  EXPECT_NE(refusalOf(options).find("IMU holds ins_t, not image_t"), std::string::npos) << refusalOf(options);
}

}  // namespace
}  // namespace redbee
