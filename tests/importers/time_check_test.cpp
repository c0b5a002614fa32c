#include "redbee/importers/time_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace redbee::test {
namespace {

TEST(TimeCheck, NoTimesAtAllAreNoFault) {
  // As of a topic whose messages are all damaged.
  for (const TimeOrder order : {TimeOrder::kSorted, TimeOrder::kAsTheyCome}) {
    const TimeFindings findings = checkTimes({}, order, "f");
    EXPECT_TRUE(findings.keep.empty());
    EXPECT_TRUE(findings.lines.empty());
  }
}

TEST(TimeCheck, AsFewAsCanBeAreLeftOut) {
  std::vector<int64_t> utimes;
  for (int k = 0; k < 100; ++k) utimes.push_back(1000 * k);
  utimes[40] = 1000 * 90;  // ahead of fifty that follow
  std::swap(utimes[60], utimes[61]);
  const TimeFindings findings = checkTimes(utimes, TimeOrder::kAsTheyCome, "f");
  EXPECT_EQ(std::count(findings.keep.begin(), findings.keep.end(), false), 2);
  EXPECT_FALSE(findings.keep[40]);
  ASSERT_EQ(findings.lines.size(), 1u);
  EXPECT_EQ(findings.lines[0], "2 of 100 do not come after the one before and are left out");
  const TimeFindings sorted = checkTimes(utimes, TimeOrder::kSorted, "f");
  EXPECT_EQ(std::count(sorted.keep.begin(), sorted.keep.end(), false), 0);
}

TEST(TimeCheck, ExtremeTimesDoNotOverflow) {
  std::vector<int64_t> utimes{INT64_MAX, INT64_MIN};
  for (int k = 0; k < 100; ++k) utimes.push_back(1000 * k);
  const TimeFindings findings = checkTimes(utimes, TimeOrder::kAsTheyCome, "f");
  EXPECT_EQ(std::count(findings.keep.begin(), findings.keep.end(), false), 2);
  EXPECT_FALSE(findings.keep[0]);
  EXPECT_FALSE(findings.keep[1]);
}

}  // namespace
}  // namespace redbee::test
