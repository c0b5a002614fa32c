#include "redbee/detection/objects/components.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "redbee/detection/foreground_maps.hpp"

namespace redbee {
namespace {

const cv::Size kImage(640, 480);

ForegroundComponents componentsOf(const cv::Mat1b& probability) {
  return findComponents(probability, cv::Mat1b::zeros(probability.size()), {});
}

TEST(FindComponents, SmallAndUnknownRegionsAreNoObjects) {
  cv::Mat1b probability = cv::Mat1b::zeros(kImage);
  probability(cv::Rect(100, 100, 20, 30)).setTo(204);
  probability(cv::Rect(300, 100, 4, 4)).setTo(204);
  probability(cv::Rect(500, 100, 20, 30)).setTo(204);
  cv::Mat1b unknown = cv::Mat1b::zeros(kImage);
  unknown(cv::Rect(480, 80, 80, 80)).setTo(255);
  const ForegroundComponents found = findComponents(probability, unknown, {});
  ASSERT_EQ(found.components.size(), 1U);
  EXPECT_EQ(found.components[0].box, cv::Rect(100, 100, 20, 30));
  EXPECT_NEAR(found.components[0].score, 0.8, 0.01);
  EXPECT_EQ(cv::countNonZero(found.mask()), found.components[0].area_px);
}

TEST(FindComponents, TheResidualAroundItIsTheMeanBeyondItsOwnFlow) {
  cv::Mat1b probability = cv::Mat1b::zeros(kImage);
  probability(cv::Rect(100, 100, 20, 30)).setTo(204);
  const cv::Mat1b unknown = cv::Mat1b::zeros(kImage);
  const auto around = [&](const cv::Mat1f& residual) {
    return findComponents(probability, unknown, {}, {{}, residual}).components.at(0).residual_around;
  };
  // At half size its box begins at (50, 50) and is 10 x 15; its flow reaches 4 further, the surroundings 15.
  cv::Mat1f residual(kImage.height / 2, kImage.width / 2, 100.0F);
  residual(cv::Rect(31, 31, 48, 53)).setTo(2);
  residual(cv::Rect(46, 46, 18, 23)).setTo(50);
  EXPECT_NEAR(around(residual), 2, 1e-6);
  residual(cv::Rect(31, 31, 48, 15)).setTo(kNotCompared);
  EXPECT_NEAR(around(residual), 2, 1e-6);
  residual.setTo(kNotCompared);
  EXPECT_EQ(around(residual), 1) << "nothing is known";
  EXPECT_EQ(findComponents(probability, unknown, {}).components.at(0).residual_around, 1);
}

TEST(FindComponents, TheGainIsTheMeanOverItsPixelsOfASmallerMap) {
  cv::Mat1b probability = cv::Mat1b::zeros(kImage);
  probability(cv::Rect(100, 100, 20, 30)).setTo(204);
  cv::Mat1f gain(kImage.height / 2, kImage.width / 2, 50.0F);
  gain(cv::Rect(50, 50, 10, 15)).setTo(3);
  gain(cv::Rect(50, 50, 5, 15)).setTo(0);
  gain(cv::Rect(50, 64, 10, 1)).setTo(kNotCompared);
  const cv::Mat1b unknown = cv::Mat1b::zeros(kImage);
  EXPECT_NEAR(findComponents(probability, unknown, {}, {gain, {}}).components.at(0).gain, 1.5, 1e-6);
  EXPECT_EQ(findComponents(probability, unknown, {}).components.at(0).gain, 1) << "not known";
  gain.setTo(kNotCompared);
  EXPECT_EQ(findComponents(probability, unknown, {}, {gain, {}}).components.at(0).gain, 1);
}

TEST(FindComponents, ThoseCountThatExceedTheWeakThresholdSomewhere) {
  cv::Mat1b probability = cv::Mat1b::zeros(kImage);
  probability(cv::Rect(100, 100, 20, 30)).setTo(90);  // 0.35
  probability(cv::Rect(105, 105, 4, 4)).setTo(140);   // 0.55
  probability(cv::Rect(300, 100, 20, 30)).setTo(90);
  const ForegroundComponents found = componentsOf(probability);
  ASSERT_EQ(found.components.size(), 1U);
  EXPECT_EQ(found.components[0].box, cv::Rect(100, 100, 20, 30));
  EXPECT_NEAR(found.components[0].peak, 140 / 255.0, 1e-9);
}

TEST(FindComponents, AHaloEndsAboveWhereAWeakObjectDoes) {
  cv::Mat1b probability = cv::Mat1b::zeros(kImage);
  probability(cv::Rect(90, 90, 40, 50)).setTo(50);  // below 0.3 of the peak of 0.9
  probability(cv::Rect(100, 100, 20, 30)).setTo(230);
  probability(cv::Rect(290, 90, 40, 50)).setTo(50);  // above 0.3 of the peak of 0.55
  probability(cv::Rect(300, 100, 20, 30)).setTo(140);
  const ForegroundComponents found = componentsOf(probability);
  ASSERT_EQ(found.components.size(), 2U);
  EXPECT_EQ(found.components[0].box, cv::Rect(100, 100, 20, 30));
  EXPECT_EQ(found.components[1].box, cv::Rect(290, 90, 40, 50));
}

TEST(FindComponents, AMaskHoldsTheComponentsThatAreKept) {
  cv::Mat1b probability = cv::Mat1b::zeros(kImage);
  probability(cv::Rect(100, 100, 20, 30)).setTo(204);
  probability(cv::Rect(300, 100, 20, 30)).setTo(204);
  const ForegroundComponents found = componentsOf(probability);
  ASSERT_EQ(found.components.size(), 2U);
  const cv::Mat1b mask = found.mask({1});
  EXPECT_EQ(cv::boundingRect(mask), found.components[1].box);
  EXPECT_EQ(cv::countNonZero(mask), found.components[1].area_px);
  EXPECT_EQ(cv::countNonZero(found.mask({})), 0);
}

TEST(FindComponents, AnEmptyMapHasNone) {
  const ForegroundComponents found = componentsOf(cv::Mat1b::zeros(kImage));
  EXPECT_TRUE(found.components.empty());
  EXPECT_EQ(found.mask().size(), kImage);
  EXPECT_EQ(cv::countNonZero(found.mask()), 0);
}

TEST(SplitComponent, EachPixelGoesToTheNearestBox) {
  cv::Mat1b probability = cv::Mat1b::zeros(kImage);
  probability(cv::Rect(100, 100, 60, 30)).setTo(204);
  ForegroundComponents found = componentsOf(probability);
  ASSERT_EQ(found.components.size(), 1U);
  const double whole = found.components[0].area_px;
  splitComponent(found, 0, {{100, 100, 20, 30}, {120, 100, 20, 30}, {140, 100, 20, 30}});
  ASSERT_EQ(found.components.size(), 3U);
  for (int i = 0; i < 3; ++i) {
    const Component& part = found.components[static_cast<size_t>(i)];
    EXPECT_NEAR(part.box.x, 100 + 20 * i, 1);
    EXPECT_NEAR(part.box.width, 20, 1);
    const cv::Mat1b mask = found.mask({static_cast<size_t>(i)});
    EXPECT_EQ(cv::countNonZero(mask), part.area_px);
    EXPECT_EQ(cv::boundingRect(mask), part.box);
  }
  EXPECT_EQ(cv::countNonZero(found.mask()), whole);
}

TEST(SplitComponent, NoMoreThanCanBeLabelled) {
  cv::Mat1b probability = cv::Mat1b::zeros(kImage);
  probability(cv::Rect(100, 100, 60, 30)).setTo(204);
  ForegroundComponents found = componentsOf(probability);
  const cv::Mat1w labels = found.labels.clone();
  found.components.resize(ForegroundComponents::kMost - 1, found.components[0]);
  splitComponent(found, 0, {{100, 100, 20, 30}, {120, 100, 20, 30}, {140, 100, 20, 30}});
  EXPECT_EQ(found.components.size(), ForegroundComponents::kMost - 1);
  EXPECT_EQ(cv::norm(found.labels, labels, cv::NORM_INF), 0);
  splitComponent(found, 0, {{100, 100, 30, 30}, {130, 100, 30, 30}});
  EXPECT_EQ(found.components.size(), ForegroundComponents::kMost);
  EXPECT_EQ(cv::countNonZero(found.labels == 65535), found.components.back().area_px) << "the last label";
}

}  // namespace
}  // namespace redbee
