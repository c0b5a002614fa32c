#include "segmentation/motion_segmenter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "segmentation/warping.hpp"
#include "simulation/scenarios.hpp"
#include "tests/segmentation/simulated_flight.hpp"

namespace redbee {
namespace {

using simulation::kFacadePatch;
using simulation::kPondPatch;
using testing::fly;
using testing::InputSource;
using testing::PixelCounts;

constexpr int kFrames = 24;

void report(const std::string& what, const PixelCounts& counts) {
  std::cout << what << ": recall " << counts.recall() << ", false share " << counts.falseShare()
            << ", false share of the patch " << counts.falsePatchShare() << "\n";
  ::testing::Test::RecordProperty(what + "_recall", std::to_string(counts.recall()));
  ::testing::Test::RecordProperty(what + "_false_share", std::to_string(counts.falseShare()));
}

void addFacade(int k, InputSource& source, SegmentationInput& input) {
  if (k > 0) input.front = source.simulator().frontHomography(k, kFacadePatch);
}

TEST(MotionSegmenter, MoverStandsOutAndFrontPlaneDoesNotWithTheDefault) {
  const PixelCounts counts = fly(simulation::twoPlanes(1), {}, kFrames, kFacadePatch);
  report("default", counts);
  EXPECT_GT(counts.recall(), 0.5);
  EXPECT_LT(counts.falsePatchShare(), 0.02);
}

TEST(MotionSegmenter, MoverStandsOutAndFrontPlaneDoesNotWithTwoPlanes) {
  // The raw foreground, for the planes alone are in question here.
  SegmentationParameters parameters = paperSegmentation();
  parameters.use_refinement = false;
  const PixelCounts both = fly(simulation::twoPlanes(1), parameters, kFrames, kFacadePatch, addFacade);
  parameters.use_front_plane = false;
  const PixelCounts ground = fly(simulation::twoPlanes(1), parameters, kFrames, kFacadePatch, addFacade);
  report("two_planes", both);
  report("ground_only", ground);
  EXPECT_GT(both.recall(), 0.3);
  EXPECT_LT(both.falsePatchShare(), 0.5 * ground.falsePatchShare());
}

TEST(MotionSegmenter, SceneWithoutFrontPlaneWorksWithTwoPlanes) {
  const PixelCounts counts = fly(simulation::walkers(2), paperSegmentation(), kFrames, 0);
  report("walkers_paper", counts);
  EXPECT_GT(counts.recall(), 0.3);
  EXPECT_LT(counts.falseShare(), 0.02);
}

TEST(MotionSegmenter, SceneWithoutFrontPlaneWorksWithTheDefault) {
  const PixelCounts counts = fly(simulation::walkers(2), {}, kFrames, 0);
  report("walkers_default", counts);
  EXPECT_GT(counts.recall(), 0.3);
  EXPECT_LT(counts.falseShare(), 0.02);
}

TEST(MotionSegmenter, WorksOnVisionAlone) {
  const auto without_motion = [](int, InputSource&, SegmentationInput& input) { input.motion.reset(); };
  const PixelCounts counts = fly(simulation::walkers(2), {}, kFrames, 0, without_motion);
  report("vision_only", counts);
  EXPECT_GT(counts.recall(), 0.3);
  EXPECT_LT(counts.falseShare(), 0.05);
}

TEST(MotionSegmenter, EntropySuppressesWavingTexture) {
  SegmentationParameters parameters = paperSegmentation();
  const PixelCounts with = fly(simulation::wavingWater(1), parameters, kFrames, kPondPatch);
  parameters.use_entropy = false;
  const PixelCounts without = fly(simulation::wavingWater(1), parameters, kFrames, kPondPatch);
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
  InputSource source(simulation::walkers(2));
  MotionSegmenter segmenter(parameters);
  SegmentationOutput output;
  for (int k = 0; k < 8; ++k) output = segmenter.step(source.input(k));
  ASSERT_EQ(output.status, SegmentationStatus::kGood);
  const cv::Mat neither = (output.probability != 0) & (output.probability != 255);
  EXPECT_EQ(cv::countNonZero(neither), 0) << "the raw foreground is a yes or no";
}

class Interruptions : public ::testing::TestWithParam<SegmentationMethod> {
 protected:
  Interruptions() : source_(testing::halfSize(simulation::walkers(3))), segmenter_(parameters()) {}

  static SegmentationParameters parameters() {
    SegmentationParameters parameters;
    parameters.method = GetParam();
    return parameters;
  }
  SegmentationOutput flyTo(int k) {
    SegmentationOutput output;
    for (; next_ <= k; ++next_) output = segmenter_.step(source_.input(next_));
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

  InputSource source_;
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

TEST_P(Interruptions, BlackPictureIsNotLearnedAndNotJudged) {
  flyTo(9);
  SegmentationInput input = source_.input(next_++);
  input.grey = cv::Mat(input.grey.size(), CV_8U, cv::Scalar(0));
  expectNothingClaimed(segmenter_.step(input), SegmentationStatus::kBadPicture);
  EXPECT_EQ(flyTo(next_).status, SegmentationStatus::kGood) << "its homography was known: nothing is lost";
}

TEST_P(Interruptions, FrozenPictureIsSaid) {
  const cv::Mat frozen = source_.input(9).grey.clone();
  flyTo(9);
  SegmentationInput input = source_.input(next_++);
  input.grey = frozen;
  expectNothingClaimed(segmenter_.step(input), SegmentationStatus::kBadPicture);
}

TEST_P(Interruptions, EmptyPictureIsSaid) {
  flyTo(9);
  SegmentationInput input = source_.input(next_);
  input.grey.release();
  EXPECT_EQ(segmenter_.step(input).status, SegmentationStatus::kBadPicture);
}

TEST_P(Interruptions, MissingHomographyStartsAnew) {
  flyTo(9);
  SegmentationInput input = source_.input(next_++);
  input.ground.reset();
  expectNothingClaimed(segmenter_.step(input), SegmentationStatus::kNoHomography);
  expectRecovery();
}

TEST_P(Interruptions, SingularHomographyIsNone) {
  flyTo(9);
  SegmentationInput input = source_.input(next_++);
  input.ground->setZero();
  expectNothingClaimed(segmenter_.step(input), SegmentationStatus::kNoHomography);
  input = source_.input(next_++);
  input.ground->setConstant(std::nan(""));
  expectNothingClaimed(segmenter_.step(input), SegmentationStatus::kNoHomography);
}

TEST_P(Interruptions, MissedFrameStartsAnew) {
  flyTo(9);
  ++next_;
  expectNothingClaimed(flyTo(next_), SegmentationStatus::kNoHomography);
  expectRecovery();
}

TEST_P(Interruptions, FrameThatComesTwiceStartsAnew) {
  flyTo(9);
  const SegmentationOutput output = segmenter_.step(source_.input(9));
  EXPECT_NE(output.status, SegmentationStatus::kGood);
  EXPECT_EQ(cv::countNonZero(output.mask), 0);
  expectRecovery();
}

TEST_P(Interruptions, FrameOutOfOrderStartsAnew) {
  flyTo(9);
  expectNothingClaimed(segmenter_.step(source_.input(5)), SegmentationStatus::kNoHomography);
  expectNothingClaimed(flyTo(next_), SegmentationStatus::kNoHomography);
  expectRecovery();
}

TEST_P(Interruptions, ChangeOfSizeStartsAnew) {
  flyTo(9);
  SegmentationInput input = source_.input(next_++);
  input.grey = input.grey(cv::Rect(0, 0, 160, 120)).clone();
  const SegmentationOutput output = segmenter_.step(input);
  expectNothingClaimed(output, SegmentationStatus::kNoHomography);
  EXPECT_EQ(output.mask.size(), cv::Size(160, 120));
  expectNothingClaimed(flyTo(next_), SegmentationStatus::kNoHomography);
  expectRecovery();
}

TEST_P(Interruptions, SameInputGivesSameOutput) {
  const SegmentationOutput first = flyTo(12);
  InputSource source(testing::halfSize(simulation::walkers(3)));
  MotionSegmenter again(parameters());
  SegmentationOutput second;
  for (int k = 0; k <= 12; ++k) second = again.step(source.input(k));
  EXPECT_EQ(cv::norm(first.probability, second.probability, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(first.mask, second.mask, cv::NORM_INF), 0);
  EXPECT_EQ(first.detections.size(), second.detections.size());
}

}  // namespace
}  // namespace redbee
