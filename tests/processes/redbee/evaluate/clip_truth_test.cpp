#include "processes/redbee/evaluate/clip_truth.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "processes/redbee/evaluate/evaluate.hpp"
#include "redbee/files/input_error.hpp"
#include "tests/support/log_events.hpp"
#include "tests/support/scratch_folder.hpp"

namespace redbee::test {
namespace {

const cv::Size kSize(32, 24);
const std::vector<int64_t> kUtimes = {0, 40'000, 80'000, 120'000};

cv::Mat maskWith(const cv::Rect& box, int value = 255) {
  cv::Mat mask = cv::Mat::zeros(kSize, CV_8U);
  mask(box).setTo(value);
  return mask;
}

void write(const fs::path& file, const cv::Mat& image) {
  fs::create_directories(file.parent_path());
  cv::imwrite(file.string(), image);
}

class ClipTruthTest : public testing::Test {
 protected:
  /// A run whose every map and mask is `map`.
  void writeRun(const cv::Mat& map) {
    for (const int64_t utime : kUtimes) {
      for (const char* kind : {"probability", "mask"}) {
        write(folder_ / "run" / kind / (std::to_string(utime) + ".png"), map);
      }
    }
  }
  fs::path truth() const { return folder_ / "truth"; }
  ScratchFolder folder_;
};

TEST_F(ClipTruthTest, MasksNamedByTimeMeetTheFramesOfTheseTimes) {
  write(truth() / "labels" / "mask" / "40000400.png",
        maskWith({0, 0, 4, 4}));  // ns, a fraction of a microsecond off
  const auto frames = ClipTruth(truth()).frames(kUtimes);
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(frames[0].utime, 40'000);
  EXPECT_EQ(frames[0].index, 1);
}

TEST_F(ClipTruthTest, MasksNumberedWithZerosMeetTheFramesInThisPlace) {
  for (const char* name : {"00000.png", "00002.png"}) write(truth() / "mask" / name, maskWith({0, 0, 4, 4}));
  const auto frames = ClipTruth(truth()).frames(kUtimes);
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[0].utime, 0);
  EXPECT_EQ(frames[1].utime, 80'000);
  EXPECT_THROW(ClipTruth(truth()).frames({0, 40'000}), InputError);
}

TEST_F(ClipTruthTest, MasksNamedAfterImagesMeetTheFramesOfTheseImages) {
  for (const char* name : {"img000001", "img000002", "img000003", "img000004"}) {
    write(truth() / "frames" / (std::string(name) + ".jpg"), maskWith({0, 0, 4, 4}));
  }
  write(truth() / "mask" / "img000003.png", maskWith({0, 0, 4, 4}));
  const auto frames = ClipTruth(truth()).frames(kUtimes);
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(frames[0].utime, 80'000);
  EXPECT_EQ(frames[0].index, 2);
  write(truth() / "mask" / "img000009.png", maskWith({0, 0, 4, 4}));
  EXPECT_THROW(ClipTruth{truth()}, InputError);
}

TEST_F(ClipTruthTest, IdentitiesGiveTheObjectsAndTheirStates) {
  write(truth() / "mask" / "40000000.png", maskWith({0, 0, 16, 4}));
  cv::Mat ids = maskWith({0, 0, 8, 4}, 1);
  ids(cv::Rect(8, 0, 8, 4)).setTo(2);
  ids(cv::Rect(0, 10, 8, 4)).setTo(3);
  write(truth() / "id" / "40000000.png", ids);
  writeText(
      truth() / "objects.csv",
      "#timestamp [ns],frame,object_id,kind,state\n40000000,1,1,person,moving\n40000000,1,2,person,moving\n"
      "40000000,1,3,person,stopped\n80000000,2,1,person,moving\n");
  const ClipTruth clip(truth());
  const auto labels = clip.read(clip.frames(kUtimes).at(0), kSize);
  EXPECT_EQ(labels.objects.objects.size(), 3u);
  // The two movers touch and yet are two; who stands still is neither missed nor a false alarm.
  const ObjectCounts counts = countObjects(maskWith({0, 0, 8, 24}), labels.objects);
  EXPECT_EQ(counts.present, 2);
  EXPECT_EQ(counts.found, 1);
  EXPECT_EQ(counts.false_alarms, 0);
}

TEST_F(ClipTruthTest, BoxesLabelEveryFrameAndIgnoredAreasGiveWayToThem) {
  write(truth() / "mask" / "00000.png", maskWith({0, 0, 4, 4}));
  writeText(truth() / "boxes.csv",
            "frame_index,frame_file,object_id,class,state,x,y,w,h\n1,f,1,car,moving,2,2,6,6\n1,f,2,car,"
            "occluded,20,2,6,6\n");
  writeText(truth() / "ignore.csv", "frame_index,x,y,w,h\n1,0,0,16,16\n");
  const ClipTruth clip(truth());
  const auto frames = clip.frames(kUtimes);
  ASSERT_EQ(frames.size(), kUtimes.size());
  EXPECT_FALSE(frames[0].mask.empty());
  EXPECT_TRUE(frames[1].mask.empty());
  const auto labels = clip.read(frames[1], kSize);
  EXPECT_TRUE(labels.mask.empty());
  EXPECT_EQ(countObjects(maskWith({2, 2, 6, 6}), labels.objects).found, 1);
  EXPECT_EQ(countObjects(maskWith({2, 2, 6, 6}), labels.objects).present, 1);  // not the hidden one
  EXPECT_EQ(labels.objects.ignored.at<uint8_t>(4, 4), 0);
  EXPECT_NE(labels.objects.ignored.at<uint8_t>(12, 12), 0);
}

TEST_F(ClipTruthTest, WithoutTruthAllThatIsDetectedIsFalse) {
  writeRun(maskWith({0, 0, 16, 12}));
  const ClipMeasures clip = measureClip({"none", folder_ / "run", {}});
  EXPECT_FALSE(clip.has_movers);
  EXPECT_DOUBLE_EQ(clip.objects.falseAreaFraction(), 0.25);
  EXPECT_DOUBLE_EQ(clip.objects.falseAlarmsPerFrame(), 1);
}

TEST_F(ClipTruthTest, ARunIsMeasuredAgainstNumberedMasks) {
  writeRun(maskWith({0, 0, 4, 4}));
  write(truth() / "mask" / "00001.png", maskWith({0, 0, 4, 4}));
  write(truth() / "mask" / "00002.png", maskWith({8, 8, 4, 4}));
  const ClipMeasures clip = measureClip({truth(), folder_ / "run", {}});
  EXPECT_EQ(clip.truth_without_result, 0);
  EXPECT_DOUBLE_EQ(clip.decided.at(1).precision, 0.5);
  EXPECT_DOUBLE_EQ(clip.decided.at(1).recall, 0.5);
  EXPECT_EQ(clip.objects.counts().false_alarms, 1);
  EXPECT_EQ(clip.frames[0].hits, 16);
  EXPECT_EQ(clip.frames[1].misses, 16);
}

TEST_F(ClipTruthTest, FramesLostByTheRunCountAsEmptyMaps) {
  writeRun(maskWith({0, 0, 4, 4}));
  for (const char* name : {"40000000.png", "50000000.png"})
    write(truth() / "mask" / name, maskWith({0, 0, 4, 4}));
  const ClipMeasures clip = measureClip({truth(), folder_ / "run", {}});
  EXPECT_EQ(clip.truth_without_result, 1);
  EXPECT_DOUBLE_EQ(clip.decided.at(1).recall, 0.5);
}

TEST_F(ClipTruthTest, WhatIsNoTruthIsRefusedWithItsName) {
  fs::create_directories(truth());
  EXPECT_NE(errorMessageOf([&] { ClipTruth clip(truth()); }).find("holds no ground-truth masks"),
            std::string::npos);
  write(truth() / "mask" / "00000.png", cv::Mat::zeros(8, 8, CV_8U));
  const ClipTruth clip(truth());
  EXPECT_NE(errorMessageOf([&] { clip.read(clip.frames(kUtimes)[0], kSize); }).find("00000.png: has 8x8 px"),
            std::string::npos);
}

}  // namespace
}  // namespace redbee::test
