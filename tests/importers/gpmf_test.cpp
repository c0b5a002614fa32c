#include "redbee/importers/gpmf.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <random>

#include "tests/support/gpmf_bytes.hpp"
#include "tests/support/log_events.hpp"

namespace redbee::test {
namespace {

TEST(GpmfTest, SamplesAreScaled) {
  const auto found = gpmfSensor(payload(0, 4), "GYRO");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].unit, "rad/s");
  EXPECT_EQ(found[0].total_after, 4);
  ASSERT_EQ(found[0].values.size(), 4u);
  EXPECT_EQ(found[0].values[3], (std::array<double, 3>{1, 2, 3}));
}

TEST(GpmfTest, OrinAndOrioTurnTheAxes) {
  Bytes extra = text("ORIN", "YxZ");
  append(extra, text("ORIO", "ZXY"));
  const auto found = gpmfSensor(payload(0, 4, "rad/s", extra), "GYRO");
  ASSERT_EQ(found.size(), 1u);
  // Stored as (Y, -X, Z) = (1, 2, 3): Z = 3, X = -2, Y = 1.
  EXPECT_EQ(found[0].values[0], (std::array<double, 3>{3, -2, 1}));
  EXPECT_EQ(found[0].axes, "ZXY");
}

TEST(GpmfTest, AMatrixTurnsTheAxesWhereThereAreNoNames) {
  Bytes numbers;
  for (const float value : {0.f, 0.f, 1.f, 0.f, -1.f, 0.f, 1.f, 0.f, 0.f}) {
    uint32_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    append(numbers, bigEndian(bits, 4));
  }
  const auto found = gpmfSensor(payload(0, 4, "rad/s", record("MTRX", 'f', 4, 9, numbers)), "GYRO");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].values[0], (std::array<double, 3>{3, -2, 1}));
}

/// It states none; a public payload of one has gravity in the third of the numbers.
TEST(GpmfTest, AFusionHasAxesOfItsOwn) {
  Bytes inside = text("DVNM", "Fusion");
  append(inside, stream("ACCL", "m/s\xB2", 1, 4, 4, {1, 2, 3}));
  const auto found = gpmfSensor(container("DEVC", inside), "ACCL");
  ASSERT_EQ(found.size(), 1u);
  // Stored as (-Y, X, Z) = (1, 2, 3).
  EXPECT_EQ(found[0].values[0], (std::array<double, 3>{3, 2, -1}));
  EXPECT_EQ(found[0].axes, "ZXY");
}

TEST(GpmfTest, EveryTruncationIsAnErrorOrShorter) {
  const Bytes whole = payload(0, 8);
  for (size_t size = 0; size < whole.size(); ++size) {
    const Bytes cut(whole.begin(), whole.begin() + static_cast<long>(size));
    try {
      EXPECT_TRUE(gpmfSensor(cut, "GYRO").empty()) << size;
    } catch (const GpmfError&) {
    }
  }
}

TEST(GpmfTest, RandomDamageNeverReadsOutside) {
  const Bytes whole = payload(0, 8);
  std::mt19937 random(7);
  int refused = 0;
  for (int round = 0; round < 5000; ++round) {
    Bytes damaged = whole;
    for (int hit = 0; hit < 3; ++hit) damaged[random() % damaged.size()] = static_cast<uint8_t>(random());
    damaged.shrink_to_fit();
    try {
      for (const GpmfSamples& samples : gpmfSensor(damaged, "GYRO"))
        EXPECT_LE(samples.values.size(), damaged.size());
    } catch (const GpmfError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 0);
}

TEST(GpmfTest, DeepNestingIsRefused) {
  Bytes nested = text("STNM", "x");
  for (int depth = 0; depth < 2 * kMaxGpmfDepth; ++depth) nested = container("DEVC", nested);
  EXPECT_THROW(gpmfSensor(nested, "GYRO"), GpmfError);
}

}  // namespace
}  // namespace redbee::test
