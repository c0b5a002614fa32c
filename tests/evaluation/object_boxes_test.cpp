#include "redbee/evaluation/object_boxes.hpp"

#include <gtest/gtest.h>

namespace redbee {
namespace {

constexpr int64_t kLeastVisible = 20;

ObjectTruth threeObjects() {
  ObjectTruth truth;
  truth.ids = cv::Mat1i::zeros(100, 100);
  truth.ids(cv::Rect(10, 10, 10, 10)) = 1;
  truth.ids(cv::Rect(40, 10, 10, 10)) = 2;
  truth.ids(cv::Rect(70, 10, 4, 4)) = 3;  // 16 px: too few
  truth.ignored = cv::Mat1b::zeros(100, 100);
  truth.ignored(cv::Rect(0, 60, 100, 40)) = 1;
  truth.objects = {{1, {}, true}, {2, {}, false}, {3, {}, true}, {4, {}, true}};  // 4 is hidden
  return truth;
}

TEST(ObjectBoxes, ObjectsThatCountHaveTheBoxOfTheirVisiblePixels) {
  const FrameBoxes boxes = ObjectBoxes(threeObjects(), kLeastVisible).compared({}, 0.5);
  ASSERT_EQ(boxes.truth.size(), 1u);
  EXPECT_EQ(boxes.truth[0].id, 1);
  EXPECT_EQ(boxes.truth[0].box, cv::Rect2d(10, 10, 10, 10));
}

TEST(ObjectBoxes, DetectionsOfWhatDoesNotCountAreLeftOut) {
  const std::vector<TrackedBox> detected{{1, {10, 10, 10, 10}},   // of object 1
                                         {2, {40, 10, 10, 9}},    // of the stopped object 2
                                         {3, {70, 10, 4, 5}},     // of the small object 3
                                         {4, {20, 70, 10, 10}},   // in an ignored area
                                         {5, {80, 30, 10, 10}}};  // of nothing
  const FrameBoxes boxes = ObjectBoxes(threeObjects(), kLeastVisible).compared(detected, 0.5);
  ASSERT_EQ(boxes.detected.size(), 2u);
  EXPECT_EQ(boxes.detected[0].id, 1);
  EXPECT_EQ(boxes.detected[1].id, 5);
}

TEST(ObjectBoxes, ObjectsLabelledByBoxesKeepThem) {
  ObjectTruth truth;
  truth.objects = {{1, {10, 10, 5, 8}, true}, {2, {30, 10, 5, 8}, false}};
  const FrameBoxes boxes = ObjectBoxes(truth, kLeastVisible).compared({{7, {30, 10, 5, 8}}}, 0.5);
  ASSERT_EQ(boxes.truth.size(), 1u);
  EXPECT_EQ(boxes.truth[0].box, cv::Rect2d(10, 10, 5, 8));
  EXPECT_TRUE(boxes.detected.empty());
}

}  // namespace
}  // namespace redbee
