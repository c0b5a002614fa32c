// What an overloaded detector leaves out.
#include <gtest/gtest.h>

#include "redbee/detection/parallax/parallax_detector.hpp"
#include "redbee/simulation/scenarios.hpp"
#include "tests/support/detector_flight.hpp"

namespace redbee::test {
namespace {

const DetectorFlight& walkersOnGrass() {
  static const DetectorFlight flight(simulation::walkers(2), 24);
  return flight;
}

using Rungs = std::vector<std::string>;

TEST(ParallaxQuality, SaysWhatIsLeftOut) {
  DetectionParameters parameters;
  EXPECT_EQ(ParallaxDetector(parameters).rungs(), Rungs{"regions are not filled"});
  parameters.appearance.use_candidates = false;
  EXPECT_EQ(ParallaxDetector(parameters).rungs(), Rungs{"regions are not filled, points are not followed"});
  parameters.appearance.enabled = false;
  EXPECT_EQ(ParallaxDetector(parameters).rungs(), Rungs{"points are not followed"});
  parameters.parallax.use_point_paths = false;
  EXPECT_EQ(ParallaxDetector(parameters).rungs(), Rungs());
}

TEST(ParallaxQuality, PointsAreNotFollowedBesideCandidates) {
  DetectionParameters without_points;
  without_points.parallax.use_point_paths = false;
  ParallaxDetector with(DetectionParameters{}), without(without_points);
  for (const FrameInput& input : walkersOnGrass().inputs) {
    const DetectorOutput a = with.step(input), b = without.step(input);
    ASSERT_EQ(cv::norm(a.mask, b.mask, cv::NORM_INF), 0);
    ASSERT_EQ(cv::norm(a.probability, b.probability, cv::NORM_INF), 0);
  }
}

TEST(ParallaxQuality, FindsHardlyLessWhereRegionsAreNotFilled) {
  ParallaxDetector whole(DetectionParameters{}), reduced(DetectionParameters{});
  PixelCounts of_whole, of_reduced;
  double apart = 0;
  for (size_t k = 0; k < walkersOnGrass().inputs.size(); ++k) {
    reduced.setQuality(1);
    const DetectorOutput a = whole.step(walkersOnGrass().inputs[k]),
                         b = reduced.step(walkersOnGrass().inputs[k]);
    apart += cv::norm(a.probability, b.probability, cv::NORM_L1);
    of_whole.add(walkersOnGrass().truths[k], a, 0);
    of_reduced.add(walkersOnGrass().truths[k], b, 0);
  }
  EXPECT_GT(apart, 0) << "something is left out";
  EXPECT_GT(of_reduced.recall(), of_whole.recall() - 0.02);
  EXPECT_LT(of_reduced.falseFraction(), of_whole.falseFraction() + 0.001);
}

}  // namespace
}  // namespace redbee::test
