#include "redbee/node/message_synchronizer.hpp"

#include <gtest/gtest.h>

#include <string>

namespace redbee {
namespace {

using Buffer = MessageSynchronizer<std::string>;
using Status = Buffer::Status;
constexpr Duration kTimeout = std::chrono::milliseconds(250);

CameraTime at(int64_t us) { return CameraTime(Duration(us)); }

TEST(MessageSynchronizer, WaitsForALivePublisherUntilItsMessage) {
  Buffer buffer(kTimeout, true);
  EXPECT_EQ(buffer.status(at(100), at(100)), Status::kPending);
  buffer.put(at(100), "here", at(100));
  EXPECT_EQ(buffer.status(at(100), at(100)), Status::kReady);
  EXPECT_EQ(*buffer.find(at(100)), "here");
}

TEST(MessageSynchronizer, AMessageThatWasOvertakenForLongIsLost) {
  Buffer buffer(kTimeout, true);
  buffer.put(at(200), "later", at(300));
  const CameraTime last_chance = at(299) + Buffer::kReordering;
  EXPECT_EQ(buffer.status(at(100), last_chance), Status::kPending) << "it may still arrive";
  EXPECT_EQ(buffer.status(at(100), at(300) + Buffer::kReordering), Status::kTimedOut);
  EXPECT_EQ(buffer.status(at(300), at(300)), Status::kPending)
      << "the publisher is alive: the next message is pending";
  EXPECT_EQ(buffer.timedOut(), 1);
}

TEST(MessageSynchronizer, AMessageThatWasOvertakenIsTaken) {
  Buffer buffer(kTimeout, true);
  buffer.put(at(200), "later", at(200));
  buffer.put(at(100), "overtaken", at(200));
  EXPECT_EQ(buffer.status(at(100), at(200)), Status::kReady);
}

TEST(MessageSynchronizer, OfSeveralMessagesAboutAFrameTheFirstIsKept) {
  Buffer buffer(kTimeout, true);
  buffer.put(at(100), "first", at(100));
  buffer.put(at(100), "second", at(100));
  EXPECT_EQ(*buffer.find(at(100)), "first");
}

TEST(MessageSynchronizer, APublisherIsDeadAfterThreeTimeoutsInARowUntilItsNextMessage) {
  Buffer buffer(kTimeout, true);
  EXPECT_EQ(buffer.status(at(100), at(100) + kTimeout), Status::kPending);
  EXPECT_EQ(buffer.status(at(100), at(101) + kTimeout), Status::kTimedOut);
  EXPECT_EQ(buffer.status(at(200), at(101) + kTimeout), Status::kPending) << "one may have been lost";
  EXPECT_EQ(buffer.status(at(200), at(201) + kTimeout), Status::kTimedOut);
  EXPECT_TRUE(buffer.isAlive());
  EXPECT_EQ(buffer.status(at(300), at(301) + kTimeout), Status::kTimedOut);
  EXPECT_FALSE(buffer.isAlive());
  EXPECT_EQ(buffer.status(at(400), at(400)), Status::kTimedOut) << "no further wait";
  EXPECT_EQ(buffer.timedOut(), 3);
  buffer.put(at(500), "back", at(500));
  EXPECT_TRUE(buffer.isAlive());
  EXPECT_EQ(buffer.status(at(600), at(600)), Status::kPending) << "its next message arrived";
}

TEST(MessageSynchronizer, AFrameThatIsAskedForAgainTimesOutOnce) {
  Buffer buffer(kTimeout, true);
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(buffer.status(at(100), at(101) + kTimeout), Status::kTimedOut);
  }
  EXPECT_EQ(buffer.timedOut(), 1);
  EXPECT_TRUE(buffer.isAlive());
}

TEST(MessageSynchronizer, AMessageFromAheadOvertakesNothing) {
  for (const Duration ahead : {Duration(1'900'000), Duration(std::chrono::hours(1))}) {
    Buffer buffer(kTimeout, true);
    buffer.put(at(100) + ahead, "stray", at(100));
    for (Duration since{}; since <= kTimeout; since += std::chrono::milliseconds(10)) {
      EXPECT_EQ(buffer.status(at(100), at(100) + since), Status::kPending);
    }
    EXPECT_EQ(buffer.status(at(100) + ahead - std::chrono::milliseconds(200), at(100) + ahead),
              Status::kPending)
        << "nor where the frames have come near";
    buffer.put(at(100) + ahead, "true", at(100) + ahead);
    EXPECT_EQ(*buffer.find(at(100) + ahead), "true");
  }
}

TEST(MessageSynchronizer, UnexpectedSourcesAreNeverPending) {
  Buffer buffer(kTimeout, false);
  EXPECT_EQ(buffer.status(at(100), at(100)), Status::kTimedOut);
  EXPECT_EQ(buffer.timedOut(), 0);
}

TEST(MessageSynchronizer, HoldsNoMoreThanItsCapacity) {
  Buffer buffer(kTimeout, true, 4);
  for (int64_t k = 0; k < 100; ++k) buffer.put(at(k), "x", at(k));
  EXPECT_EQ(buffer.size(), 4u);
  EXPECT_NE(buffer.find(at(99)), nullptr);
}

TEST(MessageSynchronizer, MessagesFromAheadDisplaceNoOther) {
  Buffer buffer(kTimeout, true, 4);
  buffer.put(at(100), "needed", at(100));
  for (int64_t k = 0; k < 100; ++k) buffer.put(at(2'000'000 + k), "stray", at(100));
  EXPECT_EQ(buffer.size(), 4u);
  EXPECT_NE(buffer.find(at(100)), nullptr);
}

}  // namespace
}  // namespace redbee
