#include "redbee/results/run_folder.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "redbee/files/json_file.hpp"
#include "redbee/results/png_file.hpp"
#include "tests/support/log_events.hpp"
#include "tests/support/scratch_folder.hpp"

namespace redbee::test {
namespace {

std::string pngOf(const cv::Mat& image) {
  std::vector<uint8_t> bytes;
  cv::imencode(".png", image, bytes);
  return {bytes.begin(), bytes.end()};
}

TEST(RunFolder, DetectionsHaveTheColumnsOfMotChallengeAndReadBack) {
  const ScratchFolder folder;
  const RunFolder run(folder.path());
  DetectionsCsv csv = run.createDetections();
  Detection detection;
  detection.id = 7;
  detection.box = {10, 20, 30, 40};
  detection.score = 0.5;
  detection.seen = false;
  csv.write(0, 123456, detection);
  EXPECT_FALSE(fs::exists(folder / "detections.csv"));
  csv.close();
  EXPECT_EQ(readText(folder / "detections.csv"),
            "frame,id,bb_left,bb_top,bb_width,bb_height,conf,x,y,z,utime,seen\n"
            "1,7,10,20,30,40,0.5,-1,-1,-1,123456,0\n");
  const DetectionsByTime read = run.detections();
  ASSERT_EQ(read.size(), 1u);
  EXPECT_EQ(read.begin()->first, 123456);
  EXPECT_EQ(read.begin()->second.id, 7);
  EXPECT_EQ(read.begin()->second.box, detection.box);
  EXPECT_EQ(read.begin()->second.score, 0.5);
  EXPECT_FALSE(read.begin()->second.seen);
}

/// Runs of 0.1 have no column `seen`.
TEST(RunFolder, DetectionsOfEarlierReleasesAreRead) {
  const ScratchFolder folder;
  writeText(
      folder / "detections.csv",
      "frame,id,bb_left,bb_top,bb_width,bb_height,conf,x,y,z,utime\n1,7,10,20,30,40,0.5,-1,-1,-1,123456\n");
  const DetectionsByTime read = RunFolder(folder.path()).detections();
  ASSERT_EQ(read.size(), 1u);
  EXPECT_TRUE(read.begin()->second.seen);
}

TEST(RunFolder, NamesOfMapsSortByTimeAndEarlierOnesAreRead) {
  const ScratchFolder folder;
  const RunFolder run(folder.path());
  run.prepare();
  for (const int64_t utime :
       {int64_t{0}, int64_t{41'667}, int64_t{1'000'000}, int64_t{1'600'000'000'000'000}})
    run.write(RunMap::kMask, utime, pngOf(cv::Mat1b(4, 4, uint8_t{255})));
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder / "mask"))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names, (std::vector<std::string>{"0000000000000000.png", "0000000000041667.png",
                                             "0000000001000000.png", "1600000000000000.png"}));
  EXPECT_TRUE(run.has(RunMap::kMask, 41'667));
  // Of releases up to 0.2.
  writeText(folder / "mask" / "83333.png", pngOf(cv::Mat1b(4, 4, uint8_t{7})));
  EXPECT_TRUE(run.has(RunMap::kMask, 83'333));
  EXPECT_EQ(run.read(RunMap::kMask, 83'333)(0, 0), 7);
  EXPECT_EQ(run.times(RunMap::kMask),
            (std::vector<int64_t>{0, 41'667, 83'333, 1'000'000, 1'600'000'000'000'000}));
}

TEST(RunFolder, HomographiesReadBackToTheLastBit) {
  const ScratchFolder folder;
  const RunFolder run(folder.path());
  const Eigen::Matrix3d H =
      (Eigen::Matrix3d() << 1 + 1e-15, 1.0 / 3, M_PI, -1e-9, 0.99, 7, 1e-7, -2e-7, 1).finished();
  HomographyCsv csv = run.createHomographies();
  csv.write(5, {2, H, std::nullopt, "fused"});
  csv.write(6, {3, std::nullopt, H, "none"});
  csv.close();
  const std::string text = readText(folder / "homography.csv");
  EXPECT_EQ(text.substr(0, 41), "utime,epoch,ground_h11,ground_h12,ground_");
  EXPECT_NE(text.find("\n5,2,1.0000000000000011,0.33333333333333331,3.1415926535897931,"), std::string::npos);
  EXPECT_NE(text.find(",front_h33,source\n"), std::string::npos);
  const auto rows = run.homographies();
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows.at(5).epoch, 2);
  EXPECT_EQ(*rows.at(5).ground, H);
  EXPECT_FALSE(rows.at(5).front);
  EXPECT_EQ(rows.at(5).source, "fused");
  EXPECT_FALSE(rows.at(6).ground);
  EXPECT_EQ(*rows.at(6).front, H);
  EXPECT_EQ(rows.at(6).source, "none");
}

TEST(RunFolder, MapsAreNamedByTimeAndReadBack) {
  const ScratchFolder folder;
  const RunFolder run(folder.path());
  run.prepare();
  const cv::Mat image = texture(40, 30, 0, 1);
  run.write(RunMap::kMask, 2'000'000, pngOf(image));
  run.write(RunMap::kMask, 1'000'000, pngOf(image));
  writeText(folder / "mask/notes.txt", "no map");
  EXPECT_TRUE(fs::exists(folder / "mask/0000000001000000.png"));
  EXPECT_EQ(run.times(RunMap::kMask), (std::vector<int64_t>{1'000'000, 2'000'000}));
  EXPECT_TRUE(run.times(RunMap::kProbability).empty());
  EXPECT_TRUE(run.has(RunMap::kMask, 1'000'000));
  EXPECT_FALSE(run.has(RunMap::kProbability, 1'000'000));
  EXPECT_EQ(cv::norm(run.read(RunMap::kMask, 1'000'000), image, cv::NORM_INF), 0);
  EXPECT_EQ(cv::countNonZero(run.readOrZeros(RunMap::kMask, 3, {40, 30})), 0);
  EXPECT_NE(errorMessageOf([&] {
              run.readOrZeros(RunMap::kMask, 1'000'000, {40, 31});
            }).find("mask/0000000001000000.png: has 40x30 px instead of 40x31"),
            std::string::npos);
}

TEST(RunFolder, PreparingRemovesTheMapsOfAnEarlierRun) {
  const ScratchFolder folder;
  const RunFolder run(folder.path() / "new" / "run");
  run.prepare();
  run.write(RunMap::kProbability, 7, "stale");
  run.prepare();
  EXPECT_TRUE(run.times(RunMap::kProbability).empty());
}

TEST(RunFolder, ErrorsNameTheFile) {
  const ScratchFolder folder;
  const RunFolder run(folder.path());
  EXPECT_NE(errorMessageOf([&] { run.times(RunMap::kMask); }).find("mask: no such folder"),
            std::string::npos);
  EXPECT_NE(
      errorMessageOf([&] { run.read(RunMap::kMask, 5); }).find("mask/0000000000000005.png: no such file"),
      std::string::npos);
  writeText(folder / "mask/6.png", "no image");
  EXPECT_NE(errorMessageOf([&] { run.read(RunMap::kMask, 6); }).find("mask/6.png: not a readable image"),
            std::string::npos);
  EXPECT_NE(errorMessageOf([&] { run.summary(); }).find("summary.json: no such file"), std::string::npos);
  writeText(folder / "homography.csv", "utime,epoch\n1,2\n");
  EXPECT_NE(errorMessageOf([&] { run.homographies(); }).find("homography.csv:1: has 2 columns instead of 21"),
            std::string::npos);
  EXPECT_NE(errorMessageOf([&] {
              writePng(folder / "none" / "mask.png", texture(40, 30, 0, 1));
            }).find("mask.png: cannot be written"),
            std::string::npos);
}

TEST(RunFolder, TheSummaryReadsBack) {
  const ScratchFolder folder;
  const RunFolder run(folder.path());
  run.writeSummary({{"frames", 240}});
  EXPECT_EQ(run.summary().at("frames"), 240);
  writeText(folder / "summary.json", "{");
  EXPECT_NE(errorMessageOf([&] { run.summary(); }).find("summary.json: "), std::string::npos);
}

}  // namespace
}  // namespace redbee::test
