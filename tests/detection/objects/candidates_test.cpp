// Candidates of maps that are drawn, judged by trees that always say the same.
#include "redbee/detection/objects/candidates.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace redbee {
namespace {

const cv::Size kMaps(160, 120), kImage(320, 240);

BoostedTrees treesThatSay(double log_odds) {
  return BoostedTrees(std::to_string(kRegionFeatures) + " " + std::to_string(log_odds) +
                      " 1\n1\n-1 0 0 0 0\n");
}

ForegroundMaps mapsWith(std::initializer_list<cv::Rect> regions) {
  ForegroundMaps maps;
  maps.appearance = cv::Mat1b::zeros(kMaps);
  maps.motion = cv::Mat1b::zeros(kMaps);
  maps.ground = cv::Mat1b::zeros(kMaps);
  maps.colours = cv::Mat4b(kMaps, cv::Vec4b(100, 100, 100, 0));
  for (const cv::Rect& region : regions) {
    maps.appearance(region).setTo(200);
    maps.motion(region).setTo(200);
  }
  return maps;
}

std::vector<Candidate> candidatesOf(const ForegroundMaps& maps, double log_odds = 2) {
  return findCandidates(maps, cv::Mat1b::zeros(kImage), {}, treesThatSay(log_odds));
}

ForegroundComponents componentsOf(const ForegroundMaps& maps, double log_odds) {
  const cv::Mat1b unknown = cv::Mat1b::zeros(kImage), probability(kImage, 100);
  ObjectParameters parameters;
  parameters.weak_threshold = parameters.threshold = 0.9;  // P_FG has none of its own
  return componentsOf(candidatesOf(maps, log_odds), probability, unknown, parameters, maps);
}

TEST(Candidates, AreRegionsAtEachLevelOfTheDifference) {
  ForegroundMaps maps = mapsWith({{60, 40, 20, 10}});
  maps.appearance(cv::Rect(55, 35, 30, 20)).setTo(100);
  maps.appearance(cv::Rect(60, 40, 20, 10)).setTo(200);
  const std::vector<Candidate> found = candidatesOf(maps);
  ASSERT_EQ(found.size(), 4U);
  EXPECT_EQ(found[0].box, cv::Rect(55, 35, 30, 20));
  EXPECT_EQ(found[1].box, cv::Rect(55, 35, 30, 20));
  EXPECT_EQ(found[2].box, cv::Rect(60, 40, 20, 10));
  EXPECT_EQ(found[3].box, cv::Rect(60, 40, 20, 10));
}

TEST(Candidates, NoneWithoutAnyEvidenceOfMotionOrWhereNothingIsKnown) {
  ForegroundMaps maps = mapsWith({{60, 40, 20, 10}});
  cv::Mat1b unknown = cv::Mat1b::zeros(kImage);
  unknown(cv::Rect(100, 60, 80, 60)).setTo(255);
  EXPECT_TRUE(findCandidates(maps, unknown, {}, treesThatSay(2)).empty());
  maps.motion.setTo(20);
  EXPECT_TRUE(candidatesOf(maps).empty());
}

TEST(Candidates, BecomeOneComponentWithLessOddsThanTheTreesSay) {
  const ForegroundComponents components = componentsOf(mapsWith({{60, 40, 20, 10}}), 3);
  ASSERT_EQ(components.components.size(), 1U) << "of four levels";
  const Component& component = components.components[0];
  EXPECT_EQ(component.box, cv::Rect(120, 80, 40, 20));
  EXPECT_EQ(component.area_px, 40 * 20);
  EXPECT_NEAR(component.peak, 1 / (1 + std::exp(-2.0)), 1e-5);
  EXPECT_NEAR(component.score, 100 / 255.0, 1e-5);
}

TEST(Candidates, UnlikelyOnesAreNoComponents) {
  EXPECT_TRUE(componentsOf(mapsWith({{60, 40, 20, 10}}), -3).components.empty());
}

}  // namespace
}  // namespace redbee
