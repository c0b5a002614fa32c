#include "redbee/evaluation/extrinsics_disturbance.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "redbee/geometry/angle.hpp"
#include "redbee/geometry/so3.hpp"

namespace redbee {
namespace {

InertialExtrinsics someTruth() {
  InertialExtrinsics truth;
  truth.R_CI = expSO3({0.3, -1.2, 0.7});
  truth.p_IC = {0.01, 0.02, 0.03};
  truth.timeshift_s = 0.007;
  truth.start_height_m = 12;
  return truth;
}

TEST(ExtrinsicsDisturbance, HasExactlyTheAmountsAskedFor) {
  const InertialExtrinsics truth = someTruth();
  for (const char* seed : {"park1", "park2", "campus1", "", "a very long name of a clip"}) {
    const InertialExtrinsics result = disturbed(truth, {}, seed);
    EXPECT_TRUE(isRotation(result.R_CI, 1e-12));
    EXPECT_NEAR(logSO3(result.R_CI * truth.R_CI.transpose()).norm(), 0.1 * kDegree, 1e-12) << seed;
    EXPECT_NEAR(std::abs(result.timeshift_s - truth.timeshift_s), 0.5e-3, 1e-12) << seed;
    EXPECT_NEAR(std::abs(result.start_height_m / truth.start_height_m - 1), 0.02, 1e-12) << seed;
    EXPECT_NEAR(result.start_height_sigma_m, 0.24, 1e-12);
    EXPECT_EQ(result.p_IC, truth.p_IC);
  }
}

TEST(ExtrinsicsDisturbance, IsTheSameEveryTimeAndAnotherForAnotherClip) {
  const InertialExtrinsics a = disturbed(someTruth(), {}, "park1"),
                           again = disturbed(someTruth(), {}, "park1"),
                           b = disturbed(someTruth(), {}, "park2");
  EXPECT_EQ(a.R_CI, again.R_CI);
  EXPECT_EQ(a.timeshift_s, again.timeshift_s);
  EXPECT_GT(logSO3(a.R_CI * b.R_CI.transpose()).norm(), 0.001 * kDegree);
}

TEST(ExtrinsicsDisturbance, SignsAndAxesAreSpreadOverTheClips) {
  int later = 0, higher = 0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  constexpr int kClips = 400;
  for (int i = 0; i < kClips; ++i) {
    const InertialExtrinsics truth = someTruth(), result = disturbed(truth, {}, "clip" + std::to_string(i));
    later += result.timeshift_s > truth.timeshift_s ? 1 : 0;
    higher += result.start_height_m > truth.start_height_m ? 1 : 0;
    sum += logSO3(result.R_CI * truth.R_CI.transpose()) / (0.1 * kDegree);
  }
  EXPECT_NEAR(later, kClips / 2.0, 50);  // five standard deviations
  EXPECT_NEAR(higher, kClips / 2.0, 50);
  EXPECT_LT(sum.norm() / kClips, 0.15);
}

TEST(ExtrinsicsDisturbance, NothingDisturbedIsTheTruth) {
  const InertialExtrinsics truth = someTruth(), result = disturbed(truth, {0, 0, 0}, "park1");
  EXPECT_LT((result.R_CI - truth.R_CI).norm(), 1e-14);
  EXPECT_EQ(result.timeshift_s, truth.timeshift_s);
  EXPECT_EQ(result.start_height_m, truth.start_height_m);
  EXPECT_EQ(result.start_height_sigma_m, truth.start_height_sigma_m);
}

}  // namespace
}  // namespace redbee
