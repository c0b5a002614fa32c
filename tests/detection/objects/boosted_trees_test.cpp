// Sums of trees that were added up by hand, and what is no such text.
#include "redbee/detection/objects/boosted_trees.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "redbee/detection/objects/candidates.hpp"

namespace redbee {
namespace {

constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();

// Two features. First tree: x0 <= 1 ? (x1 <= 5 ? 0.5 : 0.25) : -2; second: x1 <= 0 ? 1 : -1.
const char* const kTwoTrees =
    "2 0.125 2\n"
    "5\n0 1 1 4 0\n1 5 2 3 1\n-1 0.5 0 0 0\n-1 0.25 0 0 0\n-1 -2 0 0 0\n"
    "3\n1 0 1 2 0\n-1 1 0 0 0\n-1 -1 0 0 0\n";

double ofTwo(float first, float second) {
  const float features[] = {first, second};
  return BoostedTrees(kTwoTrees).logOdds(features);
}

TEST(BoostedTrees, AddsTheLeavesThatItReaches) {
  EXPECT_DOUBLE_EQ(ofTwo(0, 3), 0.125 + 0.5 - 1);
  EXPECT_DOUBLE_EQ(ofTwo(0, 6), 0.125 + 0.25 - 1);
  EXPECT_DOUBLE_EQ(ofTwo(2, -1), 0.125 - 2 + 1);
  EXPECT_DOUBLE_EQ(ofTwo(1, 5), 0.125 + 0.5 - 1) << "what equals a threshold goes to the left";
}

TEST(BoostedTrees, WhatIsMissingGoesWhereTheNodeSays) {
  EXPECT_DOUBLE_EQ(ofTwo(kMissing, -1), 0.125 - 2 + 1);
  EXPECT_DOUBLE_EQ(ofTwo(0, kMissing), 0.125 + 0.5 - 1);
}

TEST(BoostedTrees, RefusesWhatWouldReadBeyondItsNodesOrFeatures) {
  const std::string head = "2 0 1\n";
  EXPECT_NO_THROW(BoostedTrees(head + "1\n-1 1 0 0 0\n"));
  for (const char* text : {
           "",
           "2",
           "2 0",
           "2 0 1",
           "0 0 1\n1\n-1 1 0 0 0\n",
           "2 0 -1",
           "2 0 99999999999",
           "2 zero 1",
       }) {
    EXPECT_THROW(BoostedTrees{text}, std::invalid_argument) << text;
  }
  for (const char* tree : {"1\n",                                      // no node
                           "1\n2 1 0 0 0\n",                           // feature 2 of two
                           "3\n0 1 1 3 0\n-1 1 0 0 0\n-1 1 0 0 0\n",   // node 3 of three
                           "3\n0 1 0 2 0\n-1 1 0 0 0\n-1 1 0 0 0\n",   // back to itself, for ever
                           "3\n0 1 -1 2 0\n-1 1 0 0 0\n-1 1 0 0 0\n",  // before the first
                           "2\n-1 1 0 0 0\n",                          // the second is missing
                           "1\n-5 1 0 0 0\n",                          // neither a feature nor a leaf
                           "1\n-1 1 0 0 0\nmore"}) {
    EXPECT_THROW(BoostedTrees(head + tree), std::invalid_argument) << tree;
  }
}

TEST(BoostedTrees, ThoseOfTheObjectsAskForTheFeaturesThatThereAre) {
  EXPECT_EQ(objectTrees().features(), kRegionFeatures);
  RegionFeatures unknown;
  unknown.fill(kMissing);
  EXPECT_TRUE(std::isfinite(objectTrees().logOdds(unknown.data())));
}

}  // namespace
}  // namespace redbee
