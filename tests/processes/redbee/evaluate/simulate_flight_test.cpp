// The truth beside a simulated flight: the table of its objects against their pixels.
#include "processes/redbee/evaluate/simulate_flight.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>
#include <string>

#include "processes/redbee/evaluate/clip_truth.hpp"

namespace redbee {
namespace {

namespace fs = std::filesystem;

class SimulatedPark : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = fs::temp_directory_path() / ("redbee-simulate-" + std::to_string(::getpid()));
    fs::create_directories(folder_);
    SimulateOptions options;
    options.scenario = "park";
    options.seed = 5;
    options.seconds = 0.25;
    options.log = folder_ / "sim.lcm";
    options.truth = folder_ / "truth";
    runSimulate(options);
  }
  static void TearDownTestSuite() { fs::remove_all(folder_); }

  static inline fs::path folder_;
};

TEST_F(SimulatedPark, ObjectsAreTheBoxesOfTheirPixels) {
  std::ifstream table(folder_ / "truth/objects.csv");
  std::string line;
  std::getline(table, line);
  int objects = 0;
  std::map<std::string, int> pixels_of;  // stamp -> of all objects
  while (std::getline(table, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream row(line);
    std::string stamp, kind, state;
    int frame = 0, id = 0, pixels = 0;
    cv::Point first, last;
    row >> stamp >> frame >> id >> kind >> state >> pixels >> first.x >> first.y >> last.x >> last.y;
    ASSERT_TRUE(row) << line;
    const cv::Mat ids = cv::imread((folder_ / "truth/id" / (stamp + ".png")).string(), cv::IMREAD_UNCHANGED);
    EXPECT_EQ(cv::boundingRect(ids == id), cv::Rect(first, last + cv::Point(1, 1))) << line;
    EXPECT_EQ(cv::countNonZero(ids == id), pixels) << line;
    pixels_of[stamp] += pixels;
    ++objects;
  }
  EXPECT_GE(objects, 6);
  for (const auto& [stamp, pixels] : pixels_of) {
    const cv::Mat mask =
        cv::imread((folder_ / "truth/mask" / (stamp + ".png")).string(), cv::IMREAD_UNCHANGED);
    EXPECT_EQ(cv::countNonZero(mask), pixels);
  }
}

TEST_F(SimulatedPark, IsTruthThatAnEvaluationReads) {
  const ClipTruth truth(folder_ / "truth");
  const std::vector<ClipTruth::Frame> frames = truth.frames({});
  ASSERT_EQ(frames.size(), 6U);
  EXPECT_FALSE(truth.read(frames[3], {640, 480}).objects.objects.empty());
}

}  // namespace
}  // namespace redbee
