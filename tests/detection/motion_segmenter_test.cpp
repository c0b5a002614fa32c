#include "redbee/detection/motion_segmenter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "redbee/imaging/warping.hpp"
#include "redbee/simulation/scenarios.hpp"
#include "tests/detection/simulated_flight.hpp"

namespace redbee {
namespace {

using simulation::kFacadePatch;
using simulation::kPondPatch;
using testing::fly;
using testing::PixelCounts;
using testing::RecordedFlight;

constexpr int kFrames = 24;

void report(const std::string& what, const PixelCounts& counts) {
  std::cout << what << ": recall " << counts.recall() << ", false share " << counts.falseFraction()
            << ", false share of the patch " << counts.falsePatchFraction() << ", P_FG of movers "
            << counts.moverProbability() << ", of the patch " << counts.patchProbability() << "\n";
  ::testing::Test::RecordProperty(what + "_recall", std::to_string(counts.recall()));
  ::testing::Test::RecordProperty(what + "_false_fraction", std::to_string(counts.falseFraction()));
}

/// A facade beside the path, near enough that its parallax against the ground is about a pixel a frame, and
/// a car that crosses its own length within the frames that settle the background.
const RecordedFlight& facadeAndCar() {
  static const RecordedFlight flight = [] {
    simulation::Scenario scenario = simulation::twoPlanes(1);
    const simulation::Material brick = scenario.scene.patches[kFacadePatch].material;
    constexpr double kYaw = -0.7;
    scenario.scene.patches[kFacadePatch] =
        simulation::uprightPatch(simulation::PatchKind::kFront, 14, 9, kYaw, 16, 10, brick);
    scenario.scene.patches[1].motion.velocity *= 3;
    return RecordedFlight(scenario, kFrames, kFacadePatch);
  }();
  return flight;
}

const RecordedFlight& walkersOnGrass() {
  static const RecordedFlight flight(simulation::walkers(2), kFrames);
  return flight;
}

const RecordedFlight& pondAndCar() {
  static const RecordedFlight flight(simulation::wavingWater(1), kFrames);
  return flight;
}

TEST(MotionSegmenter, MoverStandsOutAndFrontPlaneDoesNotWithTheDefault) {
  const PixelCounts counts = fly(facadeAndCar(), {}, kFacadePatch);
  report("default", counts);
  EXPECT_GT(counts.recall(), 0.5);
  EXPECT_LT(counts.falsePatchFraction(), 0.02);
}

TEST(MotionSegmenter, MoverStandsOutAndFrontPlaneDoesNotWithTwoPlanes) {
  // The raw foreground, for the planes alone are in question here.
  SegmentationParameters parameters = paperSegmentation();
  parameters.use_refinement = false;
  const PixelCounts both = fly(facadeAndCar(), parameters, kFacadePatch);
  parameters.use_front_plane = false;
  const PixelCounts ground = fly(facadeAndCar(), parameters, kFacadePatch);
  report("two_planes", both);
  report("ground_only", ground);
  // Paint and grass differ by 60 +- 52 grey levels, a background's threshold is 16 to 35: about seven pixels
  // in ten stand out.
  EXPECT_GT(both.recall(), 0.5);
  EXPECT_GT(ground.falsePatchFraction(), 0.1) << "the facade must need its plane";
  EXPECT_LT(both.falsePatchFraction(), 0.25 * ground.falsePatchFraction());
}

TEST(MotionSegmenter, SceneWithoutFrontPlaneWorksWithTwoPlanes) {
  const PixelCounts counts = fly(walkersOnGrass(), paperSegmentation(), 0);
  report("walkers_paper", counts);
  EXPECT_GT(counts.recall(), 0.3);
  EXPECT_LT(counts.falseFraction(), 0.02);
}

TEST(MotionSegmenter, SceneWithoutFrontPlaneWorksWithTheDefault) {
  const PixelCounts counts = fly(walkersOnGrass(), {}, 0);
  report("walkers_default", counts);
  EXPECT_GT(counts.recall(), 0.3);
  EXPECT_LT(counts.falseFraction(), 0.02);
}

TEST(MotionSegmenter, WorksOnVisionAlone) {
  const auto without_motion = [](SegmentationInput& input) { input.motion.reset(); };
  const PixelCounts counts = fly(walkersOnGrass(), {}, 0, without_motion);
  report("vision_only", counts);
  EXPECT_GT(counts.recall(), 0.3);
  EXPECT_LT(counts.falseFraction(), 0.05);
}

TEST(MotionSegmenter, WithoutImuAndSecondPlaneAFacadeThatRunsOutOfTheImageIsStatic) {
  const auto ground_alone = [](SegmentationInput& input) {
    input.motion.reset();
    input.front.reset();
  };
  SegmentationParameters parameters;
  const PixelCounts muted = fly(facadeAndCar(), parameters, kFacadePatch, ground_alone);
  parameters.border_stretch = 0;
  const PixelCounts heard = fly(facadeAndCar(), parameters, kFacadePatch, ground_alone);
  report("muted", muted);
  report("heard", heard);
  EXPECT_GT(heard.patchProbability(), 0) << "the facade must look as if it moved";
  EXPECT_LT(muted.patchProbability(), 0.5 * heard.patchProbability());
  EXPECT_GT(muted.moverProbability(), 0.8 * heard.moverProbability());
}

TEST(MotionSegmenter, EntropySuppressesWavingTexture) {
  SegmentationParameters parameters = paperSegmentation();
  const PixelCounts with = fly(pondAndCar(), parameters, kPondPatch);
  parameters.use_entropy = false;
  const PixelCounts without = fly(pondAndCar(), parameters, kPondPatch);
  report("with_entropy", with);
  report("without_entropy", without);
  EXPECT_GT(without.patchProbability(), 0);
  EXPECT_LT(with.patchProbability(), 0.6 * without.patchProbability());
  const double mover_kept = with.moverProbability() / without.moverProbability();
  const double pond_kept = with.patchProbability() / without.patchProbability();
  std::cout << "P_FG kept by the entropy term: mover " << mover_kept << ", pond " << pond_kept << "\n";
  EXPECT_GT(mover_kept, 1.5 * pond_kept);
}

TEST(MotionSegmenter, RefinementCanBeSwitchedOff) {
  SegmentationParameters parameters = paperSegmentation();
  parameters.use_refinement = false;
  MotionSegmenter segmenter(parameters);
  SegmentationOutput output;
  for (size_t k = 0; k < 8; ++k) output = segmenter.step(walkersOnGrass().inputs[k]);
  ASSERT_EQ(output.status, SegmentationStatus::kGood);
  const cv::Mat neither = (output.probability != 0) & (output.probability != 255);
  EXPECT_EQ(cv::countNonZero(neither), 0) << "the raw foreground is a yes or no";
}

class Interruptions : public ::testing::TestWithParam<SegmentationMethod> {
 protected:
  Interruptions() : segmenter_(parameters()) {}

  static SegmentationParameters parameters() {
    SegmentationParameters parameters;
    parameters.method = GetParam();
    return parameters;
  }
  static SegmentationInput input(int k) {
    static const RecordedFlight flight(testing::halfSize(simulation::walkers(3)), kFrames);
    return flight.inputs[static_cast<size_t>(k)];
  }
  SegmentationOutput flyTo(int k) {
    SegmentationOutput output;
    for (; next_ <= k; ++next_) output = segmenter_.step(input(next_));
    return output;
  }
  static void expectNothingClaimed(const SegmentationOutput& output, SegmentationStatus status) {
    EXPECT_EQ(output.status, status) << toString(output.status);
    EXPECT_EQ(cv::countNonZero(output.mask), 0);
    EXPECT_EQ(cv::countNonZero(output.probability), 0);
    EXPECT_EQ(cv::countNonZero(output.unknown), output.unknown.size().area());
  }
  /// After an interruption the background is known again after learning_frames more frames.
  void expectRecovery() {
    const int learning = parameters().learning_frames;
    EXPECT_NE(flyTo(next_).status, SegmentationStatus::kGood);
    EXPECT_EQ(flyTo(next_ + learning).status, SegmentationStatus::kGood);
  }

  MotionSegmenter segmenter_;
  int next_ = 0;
};

INSTANTIATE_TEST_SUITE_P(Methods, Interruptions,
                         ::testing::Values(SegmentationMethod::kTwoPlanes, SegmentationMethod::kParallax));

TEST_P(Interruptions, LearnsBeforeTheFirstMask) {
  for (int k = 0; k < parameters().learning_frames; ++k) {
    expectNothingClaimed(flyTo(k), SegmentationStatus::kLearning);
  }
  EXPECT_EQ(flyTo(parameters().learning_frames).status, SegmentationStatus::kGood);
}

TEST_P(Interruptions, BlackImageIsNotLearnedAndNotJudged) {
  flyTo(9);
  SegmentationInput changed = input(next_++);
  changed.grey = cv::Mat(changed.grey.size(), CV_8U, cv::Scalar(0));
  expectNothingClaimed(segmenter_.step(changed), SegmentationStatus::kBadImage);
  EXPECT_EQ(flyTo(next_).status, SegmentationStatus::kGood) << "its homography was known: nothing is lost";
}

TEST_P(Interruptions, FrozenImageIsSaid) {
  const cv::Mat frozen = input(9).grey.clone();
  flyTo(9);
  SegmentationInput changed = input(next_++);
  changed.grey = frozen;
  expectNothingClaimed(segmenter_.step(changed), SegmentationStatus::kBadImage);
}

TEST_P(Interruptions, EmptyImageIsSaid) {
  flyTo(9);
  SegmentationInput changed = input(next_);
  changed.grey.release();
  EXPECT_EQ(segmenter_.step(changed).status, SegmentationStatus::kBadImage);
}

TEST_P(Interruptions, MissingHomographyStartsAnew) {
  flyTo(9);
  SegmentationInput changed = input(next_++);
  changed.ground.reset();
  expectNothingClaimed(segmenter_.step(changed), SegmentationStatus::kNoHomography);
  expectRecovery();
}

TEST_P(Interruptions, SingularHomographyIsNone) {
  flyTo(9);
  SegmentationInput changed = input(next_++);
  changed.ground->setZero();
  expectNothingClaimed(segmenter_.step(changed), SegmentationStatus::kNoHomography);
  changed = input(next_++);
  changed.ground->setConstant(std::nan(""));
  expectNothingClaimed(segmenter_.step(changed), SegmentationStatus::kNoHomography);
}

TEST_P(Interruptions, MissedFrameStartsAnew) {
  flyTo(9);
  ++next_;
  expectNothingClaimed(flyTo(next_), SegmentationStatus::kNoHomography);
  expectRecovery();
}

TEST_P(Interruptions, FrameThatComesTwiceStartsAnew) {
  flyTo(9);
  const SegmentationOutput output = segmenter_.step(input(9));
  EXPECT_NE(output.status, SegmentationStatus::kGood);
  EXPECT_EQ(cv::countNonZero(output.mask), 0);
  expectRecovery();
}

TEST_P(Interruptions, FrameOutOfOrderStartsAnew) {
  flyTo(9);
  expectNothingClaimed(segmenter_.step(input(5)), SegmentationStatus::kNoHomography);
  expectNothingClaimed(flyTo(next_), SegmentationStatus::kNoHomography);
  expectRecovery();
}

TEST_P(Interruptions, ChangeOfSizeStartsAnew) {
  flyTo(9);
  SegmentationInput changed = input(next_++);
  changed.grey = changed.grey(cv::Rect(0, 0, 160, 120)).clone();
  const SegmentationOutput output = segmenter_.step(changed);
  expectNothingClaimed(output, SegmentationStatus::kNoHomography);
  EXPECT_EQ(output.mask.size(), cv::Size(160, 120));
  expectNothingClaimed(flyTo(next_), SegmentationStatus::kNoHomography);
  expectRecovery();
}

TEST_P(Interruptions, SameInputGivesSameOutput) {
  const SegmentationOutput first = flyTo(12);
  MotionSegmenter again(parameters());
  SegmentationOutput second;
  for (int k = 0; k <= 12; ++k) second = again.step(input(k));
  EXPECT_EQ(cv::norm(first.probability, second.probability, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(first.mask, second.mask, cv::NORM_INF), 0);
  EXPECT_EQ(first.detections.size(), second.detections.size());
}

}  // namespace
}  // namespace redbee
