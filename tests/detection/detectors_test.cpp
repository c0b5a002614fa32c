#include <gtest/gtest.h>

#include <iostream>

#include "redbee/detection/detector.hpp"
#include "redbee/imaging/warping.hpp"
#include "redbee/simulation/scenarios.hpp"
#include "tests/support/detector_flight.hpp"

namespace redbee::test {
namespace {

using simulation::kFacadePatch;
using simulation::kPondPatch;

constexpr int kFrames = 24;

void report(const std::string& what, const PixelCounts& counts) {
  std::cout << what << ": recall " << counts.recall() << ", false fraction " << counts.falseFraction()
            << ", false fraction of the patch " << counts.falsePatchFraction() << ", P_FG of movers "
            << counts.moverProbability() << ", of the patch " << counts.patchProbability() << "\n";
  testing::Test::RecordProperty(what + "_recall", std::to_string(counts.recall()));
  testing::Test::RecordProperty(what + "_false_fraction", std::to_string(counts.falseFraction()));
}

/// A facade beside the path, near enough that its parallax against the ground is about a pixel a frame, and
/// a car that crosses its own length within the frames that settle the background.
const DetectorFlight& facadeAndCar() {
  static const DetectorFlight flight = [] {
    simulation::Scenario scenario = simulation::twoPlanes(1);
    const simulation::Material brick = scenario.scene.patches[kFacadePatch].material;
    constexpr double kYaw = -0.7;
    scenario.scene.patches[kFacadePatch] =
        simulation::uprightPatch(simulation::PatchKind::kFront, 14, 9, kYaw, 16, 10, brick);
    scenario.scene.patches[1].motion.velocity *= 3;
    return DetectorFlight(scenario, kFrames, kFacadePatch);
  }();
  return flight;
}

const DetectorFlight& walkersOnGrass() {
  static const DetectorFlight flight(simulation::walkers(2), kFrames);
  return flight;
}

const DetectorFlight& pondAndCar() {
  static const DetectorFlight flight(simulation::wavingWater(1), kFrames);
  return flight;
}

TEST(Detectors, MoverStandsOutAndFrontPlaneDoesNotWithTheDefault) {
  const PixelCounts counts = detect(facadeAndCar(), {}, kFacadePatch);
  report("default", counts);
  EXPECT_GT(counts.recall(), 0.5);
  EXPECT_LT(counts.falsePatchFraction(), 0.02);
}

TEST(Detectors, MoverStandsOutAndFrontPlaneDoesNotWithTwoPlanes) {
  // The raw foreground, for the planes alone are in question here.
  DetectionParameters parameters = paperDetection();
  parameters.refinement.enabled = false;
  const PixelCounts both = detect(facadeAndCar(), parameters, kFacadePatch);
  parameters.two_planes.use_front_plane = false;
  const PixelCounts ground = detect(facadeAndCar(), parameters, kFacadePatch);
  report("two_planes", both);
  report("ground_only", ground);
  // Paint and grass differ by 60 +- 52 grey levels, a background's threshold is 16 to 35: about seven pixels
  // in ten stand out.
  EXPECT_GT(both.recall(), 0.5);
  EXPECT_GT(ground.falsePatchFraction(), 0.1) << "the facade must need its plane";
  EXPECT_LT(both.falsePatchFraction(), 0.25 * ground.falsePatchFraction());
}

TEST(Detectors, SceneWithoutFrontPlaneWorksWithTwoPlanes) {
  const PixelCounts counts = detect(walkersOnGrass(), paperDetection(), 0);
  report("walkers_paper", counts);
  EXPECT_GT(counts.recall(), 0.3);
  EXPECT_LT(counts.falseFraction(), 0.02);
}

TEST(Detectors, SceneWithoutFrontPlaneWorksWithTheDefault) {
  const PixelCounts counts = detect(walkersOnGrass(), {}, 0);
  report("walkers_default", counts);
  EXPECT_GT(counts.recall(), 0.3);
  EXPECT_LT(counts.falseFraction(), 0.02);
}

TEST(Detectors, WorksOnVisionAlone) {
  const auto without_motion = [](FrameInput& input) { input.motion.reset(); };
  const PixelCounts counts = detect(walkersOnGrass(), {}, 0, without_motion);
  report("vision_only", counts);
  EXPECT_GT(counts.recall(), 0.3);
  EXPECT_LT(counts.falseFraction(), 0.05);
}

TEST(Detectors, WithoutImuAndSecondPlaneAFacadeThatRunsOutOfTheImageIsStatic) {
  const auto ground_alone = [](FrameInput& input) {
    input.motion.reset();
    input.front.reset();
  };
  DetectionParameters parameters;
  const PixelCounts muted = detect(facadeAndCar(), parameters, kFacadePatch, ground_alone);
  parameters.parallax.border_stretch = 0;
  const PixelCounts counted = detect(facadeAndCar(), parameters, kFacadePatch, ground_alone);
  report("muted", muted);
  report("counted", counted);
  EXPECT_GT(counted.patchProbability(), 0) << "the facade must look as if it moved";
  EXPECT_LT(muted.patchProbability(), 0.5 * counted.patchProbability());
  EXPECT_GT(muted.moverProbability(), 0.8 * counted.moverProbability());
}

TEST(Detectors, EntropySuppressesWavingTexture) {
  DetectionParameters parameters = paperDetection();
  const PixelCounts with = detect(pondAndCar(), parameters, kPondPatch);
  parameters.refinement.use_entropy = false;
  const PixelCounts without = detect(pondAndCar(), parameters, kPondPatch);
  report("with_entropy", with);
  report("without_entropy", without);
  EXPECT_GT(without.patchProbability(), 0);
  EXPECT_LT(with.patchProbability(), 0.6 * without.patchProbability());
  const double mover_kept = with.moverProbability() / without.moverProbability();
  const double pond_kept = with.patchProbability() / without.patchProbability();
  std::cout << "P_FG kept by the entropy term: mover " << mover_kept << ", pond " << pond_kept << "\n";
  EXPECT_GT(mover_kept, 1.5 * pond_kept);
}

TEST(Detectors, RefinementCanBeSwitchedOff) {
  DetectionParameters parameters = paperDetection();
  parameters.refinement.enabled = false;
  const auto detector = makeDetector(parameters);
  DetectorOutput output;
  for (size_t k = 0; k < 8; ++k) output = detector->step(walkersOnGrass().inputs[k]);
  ASSERT_EQ(output.status, DetectorStatus::kGood);
  const cv::Mat neither = (output.probability != 0) & (output.probability != 255);
  EXPECT_EQ(cv::countNonZero(neither), 0) << "the raw foreground is a yes or no";
}

}  // namespace
}  // namespace redbee::test
