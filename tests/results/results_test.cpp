#include "redbee/results/results.hpp"

#include <nlohmann/json.hpp>
#include <sstream>

#include "redbee/results/overlay.hpp"
#include "tests/support/scratch.hpp"

namespace redbee {
namespace {

using namespace testing;  // NOLINT: the test's own helpers

std::vector<std::string> fields(const std::string& line) {
  std::vector<std::string> out;
  std::stringstream in(line);
  for (std::string field; std::getline(in, field, ',');) out.push_back(field);
  return out;
}

std::vector<std::string> lines(const fs::path& file) {
  std::vector<std::string> out;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) out.push_back(line);
  return out;
}

TEST(ResultsTest, DetectionsHaveTheColumnsOfMotChallenge) {
  const ScratchFolder folder;
  DetectionsCsv csv(folder / "detections.csv");
  Detection detection;
  detection.id = 7;
  detection.box = {10, 20, 30, 40};
  detection.score = 0.5;
  csv.write(0, 123456, detection);
  EXPECT_FALSE(fs::exists(folder / "detections.csv"));
  csv.close();
  const auto rows = lines(folder / "detections.csv");
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0], "frame,id,bb_left,bb_top,bb_width,bb_height,conf,x,y,z,utime");
  EXPECT_EQ(rows[1], "1,7,10,20,30,40,0.5,-1,-1,-1,123456");
}

TEST(ResultsTest, HomographiesReadBackToTheLastBit) {
  const ScratchFolder folder;
  const Eigen::Matrix3d H =
      (Eigen::Matrix3d() << 1 + 1e-15, 1.0 / 3, M_PI, -1e-9, 0.99, 7, 1e-7, -2e-7, 1).finished();
  HomographyCsv csv(folder / "homography.csv");
  csv.write(5, 2, H, std::nullopt, "fused");
  csv.write(6, 2, std::nullopt, H, "none");
  csv.close();
  const auto rows = lines(folder / "homography.csv");
  ASSERT_EQ(rows.size(), 3u);
  const auto header = fields(rows[0]);
  const auto first = fields(rows[1]);
  const auto second = fields(rows[2]);
  ASSERT_EQ(header.size(), 21u);
  ASSERT_EQ(first.size(), 21u);
  ASSERT_EQ(second.size(), 21u);
  EXPECT_EQ(first[20], "fused");
  for (int i = 0; i < 9; ++i) {
    EXPECT_EQ(std::stod(first[static_cast<size_t>(2 + i)]), H(i / 3, i % 3));
    EXPECT_EQ(first[static_cast<size_t>(11 + i)], "");
    EXPECT_EQ(second[static_cast<size_t>(2 + i)], "");
    EXPECT_EQ(std::stod(second[static_cast<size_t>(11 + i)]), H(i / 3, i % 3));
  }
}

TEST(ResultsTest, JsonAndPngReadBack) {
  const ScratchFolder folder;
  writeJson(folder / "summary.json", {{"frames", 240}});
  EXPECT_EQ(nlohmann::json::parse(readText(folder / "summary.json")).at("frames"), 240);
  const cv::Mat mask = texture(40, 30, 0, 1);
  writePng(folder / "mask.png", mask);
  EXPECT_EQ(cv::norm(cv::imread((folder / "mask.png").string(), cv::IMREAD_UNCHANGED), mask, cv::NORM_INF),
            0);
  EXPECT_NE(
      complaintOf([&] { writePng(folder / "none" / "mask.png", mask); }).find("mask.png: cannot be written"),
      std::string::npos);
}

TEST(OverlayTest, ShowsMaskAndBoxesAndLeavesTheRest) {
  const cv::Mat image(120, 200, CV_8UC1, cv::Scalar(100));
  cv::Mat mask = cv::Mat::zeros(image.size(), CV_8UC1);
  cv::rectangle(mask, {60, 60, 20, 20}, cv::Scalar(255), cv::FILLED);
  Detection detection;
  detection.id = 3;
  detection.box = {55, 55, 30, 30};
  const cv::Mat overlay = drawOverlay(image, mask, {detection}, {1'500'000, 24, "fused", 2, ""});
  ASSERT_EQ(overlay.type(), CV_8UC3);
  EXPECT_EQ(overlay.at<cv::Vec3b>(100, 150), cv::Vec3b(100, 100, 100));
  const auto& inside = overlay.at<cv::Vec3b>(70, 70);
  EXPECT_GT(inside[2], inside[0] + 20) << "the mask is tinted red";
  EXPECT_NE(overlay.at<cv::Vec3b>(55, 70), cv::Vec3b(100, 100, 100)) << "the box";
  EXPECT_GT(cv::norm(overlay.rowRange(0, 25), cv::Mat(25, 200, CV_8UC3, cv::Scalar::all(100)), cv::NORM_INF),
            50)
      << "the status";
  EXPECT_EQ(cv::norm(image, cv::Mat(120, 200, CV_8UC1, cv::Scalar(100)), cv::NORM_INF), 0)
      << "the input is untouched";
}

}  // namespace
}  // namespace redbee
