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
  buffer.put(at(100), "here");
  EXPECT_EQ(buffer.status(at(100), at(100)), Status::kReady);
  EXPECT_EQ(*buffer.find(at(100)), "here");
}

TEST(MessageSynchronizer, ALaterMessageShowsThatThisOneWasLost) {
  Buffer buffer(kTimeout, true);
  buffer.put(at(200), "later");
  EXPECT_EQ(buffer.status(at(100), at(200)), Status::kTimedOut);
  EXPECT_EQ(buffer.status(at(300), at(300)), Status::kPending)
      << "the publisher is alive: the next message is pending";
  EXPECT_EQ(buffer.timedOut(), 1);
}

TEST(MessageSynchronizer, ADeadPublisherTimesOutOnce) {
  Buffer buffer(kTimeout, true);
  EXPECT_EQ(buffer.status(at(100), at(100) + kTimeout), Status::kPending);
  EXPECT_EQ(buffer.status(at(100), at(101) + kTimeout), Status::kTimedOut);
  EXPECT_EQ(buffer.status(at(200), at(200)), Status::kTimedOut) << "no second wait";
  EXPECT_EQ(buffer.timedOut(), 1);
  buffer.put(at(300), "back");
  EXPECT_EQ(buffer.status(at(400), at(400)), Status::kPending) << "its next message arrived";
}

TEST(MessageSynchronizer, AMessageFromFarAheadDoesNotOvertakeForEver) {
  for (const CameraTime stray : {CameraTime(std::chrono::hours(1)), CameraTime::max()}) {
    Buffer buffer(kTimeout, true);
    buffer.put(stray, "damaged");
    buffer.put(at(100), "the next");
    EXPECT_EQ(buffer.status(at(200), at(200)), Status::kPending);
  }
}

TEST(MessageSynchronizer, UnexpectedSourcesAreNeverPending) {
  Buffer buffer(kTimeout, false);
  EXPECT_EQ(buffer.status(at(100), at(100)), Status::kTimedOut);
  EXPECT_EQ(buffer.timedOut(), 0);
}

TEST(MessageSynchronizer, HoldsNoMoreThanItsCapacity) {
  Buffer buffer(kTimeout, true, 4);
  for (int64_t k = 0; k < 100; ++k) buffer.put(at(k), "x");
  EXPECT_EQ(buffer.messages().size(), 4u);
  EXPECT_NE(buffer.find(at(99)), nullptr);
}

}  // namespace
}  // namespace redbee
