// A snapshot that is stale, of another vehicle or damaged is refused, and reported.
#include <gtest/gtest.h>

#include <limits>

#include "tests/support/warm_start_run.hpp"

namespace redbee::test {
namespace {

struct Corruption {
  const char* name;
  std::function<void(filter_snapshot_t&)> corrupt;
  const char* error_message;
};

/// The publisher's number is random.
std::vector<uint8_t> contentOf(inertial_homography_t message) {
  message.publisher = 0;
  return encodeMessage(message);
}

class CorruptSnapshot : public testing::TestWithParam<Corruption> {};

TEST_P(CorruptSnapshot, ChangesNothingAndIsReported) {
  static const WarmStartFlight flight(1);
  static const RunResult without = [] {
    FaultInjection dropped;
    dropped.drop_warm_start = true;
    return run(flight, dropped);
  }();
  FaultInjection faults;
  faults.corrupt_snapshot = GetParam().corrupt;
  const RunResult result = run(flight, faults);
  EXPECT_NE(result.log.find(GetParam().error_message), std::string::npos) << result.log;
  for (int k = kBackAt; k < kFrames; ++k) {
    EXPECT_EQ(contentOf(result.homographies.at(k)), contentOf(without.homographies.at(k))) << k;
  }
}

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

INSTANTIATE_TEST_SUITE_P(
    Each, CorruptSnapshot,
    testing::Values(
        Corruption{"Stale", [](auto& m) { m.utime -= 5'000'000; }, "too old"},
        Corruption{"FromTheFuture", [](auto& m) { m.utime += 5'000'000; }, "from the future"},
        Corruption{"OfAnotherConfiguration", [](auto& m) { m.configuration[0] ^= 1; },
                   "another configuration"},
        Corruption{"HeightSigmaZero", [](auto& m) { m.height_sigma = 0; }, "implausible"},
        Corruption{"HeightUnknown", [](auto& m) { m.height_sigma = 2 * m.height; }, "implausible"},
        Corruption{"GyroBiasAbsurd", [](auto& m) { m.gyro_bias[2] = 3; }, "implausible"},
        Corruption{"MountingOfAnotherCamera",
                   [](auto& m) { fill(m.R_CI, Eigen::Matrix3d::Identity().eval()); }, "implausible"}),
    [](const auto& each) { return each.param.name; });

class DamagedSnapshot : public testing::TestWithParam<Corruption> {};

TEST_P(DamagedSnapshot, IsRefusedAndTheOneBeforeUsed) {
  static const WarmStartFlight flight(1);
  FaultInjection faults;
  faults.corrupt_snapshot = GetParam().corrupt;
  const RunResult result = run(flight, faults);
  EXPECT_NE(result.log.find(GetParam().error_message), std::string::npos) << result.log;
  EXPECT_NE(result.log.find("warm start from the filter snapshot"), std::string::npos) << result.log;
}

INSTANTIATE_TEST_SUITE_P(
    Each, DamagedSnapshot,
    testing::Values(
        Corruption{"OfAnAbsurdTime", [](auto& m) { m.utime = std::numeric_limits<int64_t>::min(); },
                   "FILTER_SNAPSHOT: a message is refused"},
        Corruption{"HeightNaN", [](auto& m) { m.height = kNaN; }, "FILTER_SNAPSHOT: a message is refused"},
        Corruption{"HeightOfASatellite", [](auto& m) { m.height = 4e5; },
                   "FILTER_SNAPSHOT: a message is refused"},
        Corruption{"BelowTheGround", [](auto& m) { m.height = -3; }, "FILTER_SNAPSHOT: a message is refused"},
        Corruption{"HeightSigmaNaN", [](auto& m) { m.height_sigma = kNaN; },
                   "FILTER_SNAPSHOT: a message is refused"},
        Corruption{"UpIsNoDirection", [](auto& m) { m.up[0] = 0.5; },
                   "FILTER_SNAPSHOT: a message is refused"},
        Corruption{"UpSigmaNaN", [](auto& m) { m.up_sigma[1] = kNaN; },
                   "FILTER_SNAPSHOT: a message is refused"},
        Corruption{"VelocityInfinite", [](auto& m) { m.velocity[1] = kInfinity; },
                   "FILTER_SNAPSHOT: a message is refused"},
        Corruption{"VelocitySigmaNegative", [](auto& m) { m.velocity_sigma[0] = -1; },
                   "FILTER_SNAPSHOT: a message is refused"},
        Corruption{"AccelBiasNaN", [](auto& m) { m.accel_bias[2] = kNaN; },
                   "FILTER_SNAPSHOT: a message is refused"},
        Corruption{"AccelBiasSigmaAbsurd", [](auto& m) { m.accel_bias_sigma[0] = 1e30; },
                   "FILTER_SNAPSHOT: a message is refused"},
        Corruption{"MountingIsNoRotation", [](auto& m) { m.R_CI[4] += 0.5; },
                   "FILTER_SNAPSHOT: a message is refused"}),
    [](const auto& each) { return each.param.name; });

}  // namespace
}  // namespace redbee::test
