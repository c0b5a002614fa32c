#include "redbee/node/publisher_choice.hpp"

#include <gtest/gtest.h>

#include "redbee/visual_homography_t.hpp"

namespace redbee {
namespace {

using Choice = PublisherChoice<visual_homography_t>;

CameraTime at(int frame) { return CameraTime(frame * Duration(41'667)); }

/// The frames whose messages are taken.
std::vector<int> admit(Choice& choice, int64_t publisher, int frame) {
  visual_homography_t message{};
  message.utime = toUtime(at(frame));
  message.publisher = publisher;
  message.inliers = frame;
  std::vector<int> frames;
  for (const visual_homography_t& taken : choice.admit(message, at(frame))) frames.push_back(taken.inliers);
  return frames;
}

TEST(PublisherChoice, ListensToTheFirstAndIgnoresTheSecond) {
  Choice choice;
  for (int k = 0; k < 50; ++k) {
    EXPECT_EQ(admit(choice, 1, k), std::vector<int>{k});
    EXPECT_TRUE(admit(choice, 2, k).empty());
  }
  EXPECT_EQ(choice.takeIgnored(), 49);
  EXPECT_FALSE(choice.takeChange());
}

TEST(PublisherChoice, FollowsARestartedPublisherAndLosesNothing) {
  Choice choice;
  admit(choice, 1, 0);
  for (int k = 1; k < 5; ++k) EXPECT_TRUE(admit(choice, 2, k).empty());
  EXPECT_EQ(admit(choice, 2, 5), (std::vector<int>{1, 2, 3, 4, 5}));
  EXPECT_TRUE(choice.takeChange());
  EXPECT_EQ(admit(choice, 2, 6), std::vector<int>{6});
  EXPECT_TRUE(admit(choice, 1, 6).empty());
}

TEST(PublisherChoice, FollowsAtOnceAfterASilence) {
  Choice choice;
  admit(choice, 1, 0);
  EXPECT_EQ(admit(choice, 2, 7), std::vector<int>{7});
}

TEST(PublisherChoice, ListensToTheFirstWhereTheNodeKnewNoTimeBefore) {
  Choice choice;
  visual_homography_t message{};
  message.utime = toUtime(at(100));
  message.publisher = 1;
  EXPECT_EQ(choice.admit(message, CameraTime()).size(), 1U);
  EXPECT_TRUE(admit(choice, 2, 101).empty());
}

TEST(PublisherChoice, AddsNoMessagesOfSeveralOthers) {
  Choice choice;
  admit(choice, 1, 0);
  for (int i = 0; i < 20; ++i) EXPECT_TRUE(admit(choice, 2 + i, 1).empty());
}

}  // namespace
}  // namespace redbee
