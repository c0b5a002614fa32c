#include "processes/redbee/evaluate/outcome_images.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace redbee {
namespace {

const cv::Size kSize(32, 24);

cv::Mat1b maskWith(const cv::Rect& box) {
  cv::Mat1b mask = cv::Mat1b::zeros(kSize);
  mask(box).setTo(255);
  return mask;
}

FrameOutcome outcome(int64_t hits, int64_t false_alarms, int64_t misses) {
  FrameOutcome frame;
  frame.hits = hits;
  frame.false_alarms = false_alarms;
  frame.misses = misses;
  return frame;
}

TEST(RepresentativeFrames, AreTheBestAndTheWorstAndNotNeighbours) {
  std::vector<FrameOutcome> frames(40, outcome(50, 25, 25));
  frames[10] = outcome(100, 0, 0);
  frames[11] = outcome(99, 0, 1);
  frames[20] = outcome(90, 5, 5);
  frames[30] = outcome(0, 10, 100);
  frames[0] = outcome(0, 0, 5);
  const RepresentativeFrames chosen = chooseRepresentativeFrames(frames, 2);
  EXPECT_EQ(chosen.best, (std::vector<size_t>{10, 20}));
  EXPECT_EQ(chosen.worst, (std::vector<size_t>{0, 30}));
}

TEST(RepresentativeFrames, WhereNothingMovesTheMostFalseOnesAreTheWorst) {
  std::vector<FrameOutcome> frames(30, outcome(0, 1, 0));
  frames[25] = outcome(0, 50, 0);
  const RepresentativeFrames chosen = chooseRepresentativeFrames(frames, 1);
  EXPECT_TRUE(chosen.best.empty());
  EXPECT_EQ(chosen.worst, std::vector<size_t>{25});
  EXPECT_TRUE(chooseRepresentativeFrames({}, 2).worst.empty());
}

TEST(OutcomeImages, EveryKindHasItsColour) {
  ClipTruth::Labels labels;
  labels.mask = maskWith({0, 0, 8, 8});
  labels.mask(cv::Rect(20, 0, 8, 8)).setTo(170);
  const cv::Mat drawn = drawOutcome(cv::Mat1b(kSize, 100), maskWith({4, 0, 8, 8}), labels);
  const auto strongest = [&](int x, int y) {
    const auto& pixel = drawn.at<cv::Vec3b>(y, x);
    return std::max_element(pixel.val, pixel.val + 3) - pixel.val;  // 0 blue, 1 green, 2 red
  };
  EXPECT_EQ(strongest(5, 2), 1);
  EXPECT_EQ(strongest(10, 2), 2);
  EXPECT_EQ(strongest(1, 2), 0);
  EXPECT_EQ(drawn.at<cv::Vec3b>(20, 5), cv::Vec3b(100, 100, 100));
  EXPECT_EQ(cv::countNonZero(drawn(cv::Rect(20, 0, 8, 8)).reshape(1) != 100), 3 * 8);  // hatched
}

TEST(OutcomeImages, LegendExplainsTheColours) {
  const std::string legend = outcomeLegend();
  for (const char* text : {"hit", "false alarm", "miss", "only boxes are labelled", "truth unknown"}) {
    EXPECT_NE(legend.find(text), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace redbee
