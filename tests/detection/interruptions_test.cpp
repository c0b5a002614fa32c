// If its input is interrupted, damaged or out of order, a detector reports nothing and recovers.
#include <gtest/gtest.h>

#include <cmath>

#include "redbee/detection/detector.hpp"
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

TEST_P(Interruptions, AFrozenImageIsReported) {
  const cv::Mat frozen = input(9).grey.clone();
  flyTo(9);
  FrameInput changed = input(next_++);
  changed.grey = frozen;
  expectNothingClaimed(detector_->step(changed), DetectorStatus::kBadImage);
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
