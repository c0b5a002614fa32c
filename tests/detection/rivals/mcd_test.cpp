#include "redbee/detection/rivals/mcd.hpp"

#include <gtest/gtest.h>

namespace redbee {
namespace {

TEST(McdModel, MatchingBlockIsAveragedByAge) {
  DualModel model{GreyGaussian{100, 200, 3}, GreyGaussian{0, 400, 0}};
  updateDualModel(model, 104, 100, 108);
  EXPECT_FLOAT_EQ(model[0].mean, 101);  // 3/4 100 + 1/4 104
  EXPECT_FLOAT_EQ(model[0].variance, 0.75F * 200 + 0.25F * 49) << "greatest (I - mean)^2 is (108 - 101)^2";
  EXPECT_FLOAT_EQ(model[0].age, 4);
  EXPECT_FLOAT_EQ(model[1].age, 0);
}

TEST(McdModel, MatchIsWithinTwoVariances) {
  DualModel model{GreyGaussian{100, 50, 5}, GreyGaussian{0, 400, 0}};
  updateDualModel(model, 109, 109, 109);
  EXPECT_FLOAT_EQ(model[0].age, 6) << "81 < 2 * 50";
  model = {GreyGaussian{100, 50, 5}, GreyGaussian{0, 400, 0}};
  updateDualModel(model, 110, 110, 110);
  EXPECT_FLOAT_EQ(model[0].age, 5) << "100 is not less than 2 * 50";
  EXPECT_FLOAT_EQ(model[1].mean, 110);
  EXPECT_FLOAT_EQ(model[1].age, 1);
}

TEST(McdModel, ANewCandidateStartsWide) {
  DualModel model{GreyGaussian{100, 50, 5}, GreyGaussian{150, 50, 2}};
  updateDualModel(model, 200, 198, 203);
  EXPECT_FLOAT_EQ(model[1].mean, 200);
  EXPECT_FLOAT_EQ(model[1].variance, 400) << "observed 9, but the first is at least 400";
  EXPECT_FLOAT_EQ(model[1].age, 1);
  EXPECT_FLOAT_EQ(model[0].mean, 100) << "the background keeps what it knows";
}

TEST(McdModel, TheOlderCandidateReplacesTheBackground) {
  DualModel model{GreyGaussian{100, 50, 3}, GreyGaussian{200, 60, 4}};
  updateDualModel(model, 200, 200, 200);
  EXPECT_FLOAT_EQ(model[0].mean, 200);
  EXPECT_FLOAT_EQ(model[0].age, 5);
  EXPECT_FLOAT_EQ(model[1].age, 0);
}

TEST(McdModel, ACandidateAsOldReplacesTheBackground) {
  DualModel model{GreyGaussian{100, 50, 4}, GreyGaussian{200, 60, 4}};
  const BlockBackground background = updateDualModel(model, 200, 200, 200);
  EXPECT_FLOAT_EQ(model[0].mean, 200);
  EXPECT_FLOAT_EQ(background.mean, 200) << "and this frame is compared with it already";
  EXPECT_FLOAT_EQ(background.variance, 60);
}

TEST(McdModel, PixelsAreScoredByTheMeanWithThemAndTheVarianceWithoutThem) {
  DualModel model{GreyGaussian{100, 100, 3}, GreyGaussian{0, 400, 0}};
  const BlockBackground background = updateDualModel(model, 104, 100, 108);
  EXPECT_FLOAT_EQ(background.mean, 101);
  EXPECT_FLOAT_EQ(background.variance, 100);
  EXPECT_TRUE(background.classifies);
}

TEST(McdModel, AYoungBackgroundDoesNotScore) {
  for (const float age : {0.5F, 1.0F, 1.5F}) {
    DualModel model{GreyGaussian{100, 100, age}, GreyGaussian{0, 400, 0}};
    EXPECT_EQ(updateDualModel(model, 104, 100, 108).classifies, age > 1) << age;
  }
}

TEST(McdModel, VarianceRestartsOnlyWhereNothingIsKnown) {
  DualModel model{GreyGaussian{100, 900, 0.5F}, GreyGaussian{0, 400, 0}};
  updateDualModel(model, 103, 103, 103);
  EXPECT_FLOAT_EQ(model[0].mean, 103) << "less than one frame old";
  EXPECT_NEAR(model[0].variance, 300, 1e-3) << "1/3 of 900 and 2/3 of 0";
}

TEST(McdModel, AgeAndVarianceAreBounded) {
  DualModel model{GreyGaussian{100, 100, 10}, GreyGaussian{0, 400, 0}};
  updateDualModel(model, 100, 100, 100);
  EXPECT_FLOAT_EQ(model[0].age, 10);
  EXPECT_FLOAT_EQ(model[0].variance, 100);
}

TEST(McdModel, BlendCountsTheSpreadOfTheMeans) {
  const GreyGaussian a{100, 40, 4};
  const GreyGaussian b{120, 60, 8};
  const GreyGaussian blend = blendGaussians({a, b, {}, {}}, {0.25F, 0.75F, 0, 0});
  EXPECT_FLOAT_EQ(blend.mean, 115);
  EXPECT_FLOAT_EQ(blend.variance, 0.25F * (40 + 225) + 0.75F * (60 + 25));
  EXPECT_FLOAT_EQ(blend.age, 7);
}

TEST(McdModel, BlendForgetsWhereTheVarianceIsLarge) {
  const GreyGaussian wild{100, 3500, 20};
  const GreyGaussian blend = blendGaussians({wild, {}, {}, {}}, {1, 0, 0, 0});
  EXPECT_NEAR(blend.age, 20 * std::exp(-1.0), 1e-4) << "exp(-0.001 (3500 - 2500))";
}

TEST(McdModel, NothingIsKnownOutside) {
  const GreyGaussian blend = blendGaussians({}, {0, 0, 0, 0});
  EXPECT_FLOAT_EQ(blend.age, 0);
  EXPECT_FLOAT_EQ(blend.variance, 400);
  const GreyGaussian edge = blendGaussians({GreyGaussian{80, 30, 9}, {}, {}, {}}, {0.5F, 0, 0, 0});
  EXPECT_FLOAT_EQ(edge.mean, 80) << "what lies inside counts alone";
  EXPECT_FLOAT_EQ(edge.age, 9);
}

}  // namespace
}  // namespace redbee
