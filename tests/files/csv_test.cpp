#include "redbee/files/csv.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace redbee {
namespace {

TEST(Csv, NanosecondsRoundToTheNearestEvenAtTheEdges) {
  EXPECT_EQ(microseconds(int64_t{1499}), 1);
  EXPECT_EQ(microseconds(int64_t{1500}), 2);
  EXPECT_EQ(microseconds(int64_t{-1499}), -1);
  EXPECT_EQ(microseconds(int64_t{-1500}), -2);
  EXPECT_EQ(microseconds(std::numeric_limits<int64_t>::max()), 9223372036854776);
  EXPECT_EQ(microseconds(std::numeric_limits<int64_t>::min()), -9223372036854776);
}

}  // namespace
}  // namespace redbee
