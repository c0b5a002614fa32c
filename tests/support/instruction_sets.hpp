// Tests of vector code run with every set of instructions that the processor has.
#pragma once

#include <gtest/gtest.h>

#include <string>

// The targets are chosen before Highway is included.
// clang-format off
#include "redbee/imaging/simd.hpp"
#include <hwy/targets.h>
// clang-format on

namespace redbee::test {

class WithInstructions : public testing::TestWithParam<int64_t> {
 protected:
  void SetUp() override { hwy::SetSupportedTargetsForTest(GetParam()); }
  void TearDown() override { hwy::SetSupportedTargetsForTest(0); }
};

}  // namespace redbee::test

#define REDBEE_WITH_INSTRUCTIONS(fixture)                                                                 \
  INSTANTIATE_TEST_SUITE_P(Instructions, fixture, testing::ValuesIn(hwy::SupportedAndGeneratedTargets()), \
                           [](const auto& of) { return std::string(hwy::TargetName(of.param)); })
