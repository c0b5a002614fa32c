// Fused homographies that reach the inertial process late, or never.
#include <gtest/gtest.h>

#include "tests/support/warm_start_run.hpp"

namespace redbee::test {
namespace {

struct Feedback {
  int corrected = 0;  ///< frames before which there was a correction, or several late ones
  int counted = 0;
  double error_px = 0;  ///< mean
  double worst_px = 0;
  double height = 0;  ///< of the last frame, fraction of the true one
};

Feedback fly(const FaultInjection& faults, unsigned seed) {
  const WarmStartFlight flight(seed);
  const RunResult result = run(flight, faults);
  Feedback sum;
  for (int k = 2 * 24; k < kFrames - 15; ++k) {
    if (result.homographies.count(k) == 0) continue;
    const inertial_homography_t& m = result.homographies.at(k);
    sum.corrected += m.feedback_test_ratio > 0 ? 1 : 0;
    const double error = error_px(flight, result, k);
    sum.error_px += error;
    sum.worst_px = std::max(sum.worst_px, error);
    ++sum.counted;
  }
  sum.error_px /= sum.counted;
  const int last = result.homographies.rbegin()->first;
  sum.height = std::abs(result.homographies.at(last).camera_height / flight.trueHeight(last) - 1);
  std::printf("seed %u delay %.2f lost %.2f: %d corrected of %d, %.2f px, worst %.2f, height %.3f\n", seed,
              seconds(faults.feedback_delay), faults.feedback_lost, sum.corrected, sum.counted, sum.error_px,
              sum.worst_px, sum.height);
  return sum;
}

FaultInjection feedback(Duration delay, double lost) {
  FaultInjection faults;
  faults.restarted_at = -1;
  faults.feedback_delay = delay;
  faults.feedback_lost = lost;
  return faults;
}

/// As it is where vision falls behind: later than the inertial process waits for it, too.
TEST(LateFeedback, StillCorrectsTheFilter) {
  for (const unsigned seed : {1U, 2U}) {
    for (const int delay_ms : {30, 80, 200, 300, 400}) {
      const Feedback late = fly(feedback(std::chrono::milliseconds(delay_ms), 0), seed);
      EXPECT_LT(late.error_px, 0.3);
      EXPECT_LT(late.height, 0.05);
    }
  }
}

TEST(LateFeedback, ThatIsLostCostsItsOwnCorrectionsOnly) {
  for (const unsigned seed : {1U, 2U}) {
    const Feedback halved = fly(feedback(Duration(0), 0.5), seed);
    EXPECT_LT(halved.error_px, 0.3);
    EXPECT_LT(halved.height, 0.05);
  }
}

}  // namespace
}  // namespace redbee::test
