// If its input is interrupted, damaged or out of order, a detector reports nothing and recovers.
#include <gtest/gtest.h>

#include <cmath>

#include "redbee/detection/detector.hpp"
#include "redbee/geometry/compose_motion.hpp"
#include "redbee/imaging/repeated_image.hpp"
#include "tests/support/detector_flight.hpp"

namespace redbee::test {
namespace {

constexpr int kFrames = 24;

class Interruptions : public testing::TestWithParam<const char*> {
 protected:
  Interruptions() : detector_(makeDetector(parameters())) {}

  static DetectionParameters parameters() {
    DetectionParameters parameters;
    parameters.method = GetParam();
    return parameters;
  }
  static FrameInput input(int k) {
    static const DetectorFlight flight(halfSize(simulation::walkers(3)), kFrames);
    return flight.inputs[static_cast<size_t>(k)];
  }
  static FrameInput withImageOf(FrameInput frame, const FrameInput& other) {
    frame.grey = other.grey.clone();
    frame.colour = other.colour.clone();
    return frame;
  }
  DetectorOutput flyTo(int k) {
    DetectorOutput output;
    for (; next_ <= k; ++next_) output = detector_->step(input(next_));
    return output;
  }
  static void expectNothingClaimed(const DetectorOutput& output, DetectorStatus status) {
    EXPECT_EQ(output.status, status) << toString(output.status);
    EXPECT_EQ(cv::countNonZero(output.mask), 0);
    EXPECT_EQ(cv::countNonZero(output.probability), 0);
    EXPECT_EQ(cv::countNonZero(output.unknown), output.unknown.size().area());
  }
  /// After an interruption the background is known again after learning_frames more frames.
  void expectRecovery() {
    const int learning = parameters().learning_frames;
    EXPECT_NE(flyTo(next_).status, DetectorStatus::kGood);
    EXPECT_EQ(flyTo(next_ + learning).status, DetectorStatus::kGood);
  }

  std::unique_ptr<Detector> detector_;
  int next_ = 0;
};

INSTANTIATE_TEST_SUITE_P(Methods, Interruptions, testing::Values("two_planes", "parallax"));

TEST_P(Interruptions, LearnsBeforeTheFirstMask) {
  for (int k = 0; k < parameters().learning_frames; ++k) {
    expectNothingClaimed(flyTo(k), DetectorStatus::kLearning);
  }
  EXPECT_EQ(flyTo(parameters().learning_frames).status, DetectorStatus::kGood);
}

TEST_P(Interruptions, ABlackImageIsNeitherLearnedNorClassified) {
  flyTo(9);
  FrameInput changed = input(next_++);
  changed.grey = cv::Mat(changed.grey.size(), CV_8U, cv::Scalar(0));
  expectNothingClaimed(detector_->step(changed), DetectorStatus::kBadImage);
  EXPECT_EQ(flyTo(next_).status, DetectorStatus::kGood) << "its homography was known: nothing is lost";
}

TEST_P(Interruptions, AnImageThatIsFrozenForLongIsReported) {
  const FrameInput frozen = input(9);
  flyTo(9);
  for (; input(next_).time - frozen.time <= kMaxRepetition; ++next_) {
    EXPECT_EQ(detector_->step(withImageOf(input(next_), frozen)).status, DetectorStatus::kGood);
  }
  expectNothingClaimed(detector_->step(withImageOf(input(next_), frozen)), DetectorStatus::kBadImage);
}

TEST_P(Interruptions, MaskAndBoxesStayWhereAnImageIsRepeated) {
  const DetectorOutput last = flyTo(20);
  ASSERT_FALSE(last.detections.empty());
  const DetectorOutput repeated = detector_->step(withImageOf(input(21), input(20)));
  EXPECT_EQ(repeated.status, DetectorStatus::kGood);
  EXPECT_EQ(repeated.time, input(21).time);
  EXPECT_EQ(cv::norm(repeated.mask, last.mask, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(repeated.probability, last.probability, cv::NORM_INF), 0);
  ASSERT_EQ(repeated.detections.size(), last.detections.size());
  for (size_t i = 0; i < last.detections.size(); ++i) {
    EXPECT_EQ(repeated.detections[i].id, last.detections[i].id);
    EXPECT_EQ(repeated.detections[i].box, last.detections[i].box);
    EXPECT_EQ(repeated.detections[i].seen, last.detections[i].seen);
  }
}

TEST_P(Interruptions, ARepeatedImageIsTheSameAsAMissingFrame) {
  flyTo(12);
  detector_->step(withImageOf(input(13), input(12)));
  const DetectorOutput after = detector_->step(input(14));
  const auto other = makeDetector(parameters());
  for (int k = 0; k <= 12; ++k) other->step(input(k));
  FrameInput both = input(14);
  both.time_previous = input(12).time;
  both.ground = normaliseHomography(*input(14).ground * *input(13).ground);
  if (both.front) both.front = normaliseHomography(*input(14).front * *input(13).front);
  if (both.motion) both.motion = compose(*input(14).motion, *input(13).motion);
  const DetectorOutput expected = other->step(both);
  EXPECT_EQ(after.status, DetectorStatus::kGood);
  EXPECT_EQ(cv::norm(after.probability, expected.probability, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(after.mask, expected.mask, cv::NORM_INF), 0);
}

TEST_P(Interruptions, AnEmptyImageIsReported) {
  flyTo(9);
  FrameInput changed = input(next_);
  changed.grey.release();
  EXPECT_EQ(detector_->step(changed).status, DetectorStatus::kBadImage);
}

TEST_P(Interruptions, AMissingHomographyRestarts) {
  flyTo(9);
  FrameInput changed = input(next_++);
  changed.ground.reset();
  expectNothingClaimed(detector_->step(changed), DetectorStatus::kNoHomography);
  expectRecovery();
}

TEST_P(Interruptions, SingularHomographyIsNone) {
  flyTo(9);
  FrameInput changed = input(next_++);
  changed.ground->setZero();
  expectNothingClaimed(detector_->step(changed), DetectorStatus::kNoHomography);
  changed = input(next_++);
  changed.ground->setConstant(std::nan(""));
  expectNothingClaimed(detector_->step(changed), DetectorStatus::kNoHomography);
}

TEST_P(Interruptions, AMissedFrameRestarts) {
  flyTo(9);
  ++next_;
  expectNothingClaimed(flyTo(next_), DetectorStatus::kNoHomography);
  expectRecovery();
}

TEST_P(Interruptions, AFrameThatComesTwiceRestarts) {
  flyTo(9);
  const DetectorOutput output = detector_->step(input(9));
  EXPECT_NE(output.status, DetectorStatus::kGood);
  EXPECT_EQ(cv::countNonZero(output.mask), 0);
  expectRecovery();
}

TEST_P(Interruptions, AFrameOutOfOrderRestarts) {
  flyTo(9);
  expectNothingClaimed(detector_->step(input(5)), DetectorStatus::kNoHomography);
  expectNothingClaimed(flyTo(next_), DetectorStatus::kNoHomography);
  expectRecovery();
}

TEST_P(Interruptions, AChangeOfSizeRestarts) {
  flyTo(9);
  FrameInput changed = input(next_++);
  changed.grey = changed.grey(cv::Rect(0, 0, 160, 120)).clone();
  const DetectorOutput output = detector_->step(changed);
  expectNothingClaimed(output, DetectorStatus::kNoHomography);
  EXPECT_EQ(output.mask.size(), cv::Size(160, 120));
  expectNothingClaimed(flyTo(next_), DetectorStatus::kNoHomography);
  expectRecovery();
}

TEST_P(Interruptions, SameInputGivesSameOutput) {
  const DetectorOutput first = flyTo(12);
  const auto again = makeDetector(parameters());
  DetectorOutput second;
  for (int k = 0; k <= 12; ++k) second = again->step(input(k));
  EXPECT_EQ(cv::norm(first.probability, second.probability, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(first.mask, second.mask, cv::NORM_INF), 0);
  EXPECT_EQ(first.detections.size(), second.detections.size());
}

}  // namespace
}  // namespace redbee::test
