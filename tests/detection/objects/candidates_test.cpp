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

ForegroundComponents componentsOfForeground(const cv::Mat1b& probability) {
  return findComponents(probability, cv::Mat1b::zeros(kImage), {});
}

/// P_FG of the image: nothing, or a rectangle.
cv::Mat1b foreground(const cv::Rect& region = {}) {
  cv::Mat1b probability = cv::Mat1b::zeros(kImage);
  probability(region).setTo(230);
  return probability;
}

std::vector<Candidate> candidatesOf(const ForegroundMaps& maps, double log_odds = 2,
                                    const cv::Mat1b& probability = foreground()) {
  return findCandidates(maps, cv::Mat1b::zeros(kImage), componentsOfForeground(probability), {},
                        treesThatSay(log_odds));
}

ForegroundComponents componentsOf(const ForegroundMaps& maps, double log_odds,
                                  const cv::Mat1b& probability = foreground()) {
  return componentsOf(candidatesOf(maps, log_odds, probability), componentsOfForeground(probability),
                      probability, cv::Mat1b::zeros(kImage), maps);
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
  EXPECT_TRUE(
      findCandidates(maps, unknown, componentsOfForeground(foreground()), {}, treesThatSay(2)).empty());
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
}

TEST(Candidates, AreComponentsOfTheForegroundToo) {
  const cv::Mat1b probability = foreground({41, 60, 20, 31});
  const std::vector<Candidate> found = candidatesOf(mapsWith({}), 2, probability);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].component, 0U);
  EXPECT_EQ(found[0].box, cv::Rect(20, 30, 11, 16)) << "every pixel of the maps that it touches";
  const ForegroundComponents components = componentsOf(mapsWith({}), 3, probability);
  ASSERT_EQ(components.components.size(), 1U);
  EXPECT_EQ(components.components[0].box, cv::Rect(41, 60, 20, 31)) << "as P_FG has it";
  EXPECT_EQ(components.components[0].area_px, componentsOfForeground(probability).components[0].area_px);
  EXPECT_NEAR(components.components[0].peak, 230 / 255.0, 1e-5);
  EXPECT_NEAR(components.components[0].score, 230 / 255.0, 1e-5);
}

TEST(Candidates, OfTwoThatCoverEachOtherASureRegionStaysElseTheComponentOfTheForeground) {
  const ForegroundMaps maps = mapsWith({{60, 40, 20, 10}});
  const cv::Rect region(120, 80, 40, 20), of_foreground(122, 82, 30, 16);
  const cv::Mat1b probability = foreground(of_foreground);
  EXPECT_EQ(candidatesOf(maps, 2, probability).size(), 5U);
  for (const double log_odds : {3.0, 2.0, 0.0}) {
    const ForegroundComponents components = componentsOf(maps, log_odds, probability);
    ASSERT_EQ(components.components.size(), 1U);
    EXPECT_EQ(components.components[0].box, log_odds > 2.5 ? region : of_foreground) << log_odds;
  }
}

TEST(Candidates, ComponentsOfTheForegroundThatTheTreesRejectAreNone) {
  EXPECT_TRUE(componentsOf(mapsWith({}), -3, foreground({41, 60, 20, 31})).components.empty());
}

TEST(Candidates, AComponentThatIsLargerThanTheTreesKnowStays) {
  const cv::Mat1b probability = foreground({40, 60, 100, 80});
  EXPECT_TRUE(candidatesOf(mapsWith({}), 2, probability).empty());
  const ForegroundComponents components = componentsOf(mapsWith({}), -3, probability);
  ASSERT_EQ(components.components.size(), 1U);
  EXPECT_EQ(components.components[0].box, cv::Rect(40, 60, 100, 80));
  EXPECT_NEAR(components.components[0].peak, 230 / 255.0, 1e-5);
}

TEST(Candidates, UnlikelyOnesAreNoComponents) {
  EXPECT_TRUE(componentsOf(mapsWith({{60, 40, 20, 10}}), -3).components.empty());
}

}  // namespace
}  // namespace redbee
