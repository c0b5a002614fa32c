#include "redbee/node/message_synchronizer.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace redbee {
namespace {

using Buffer = MessageSynchronizer<std::string>;
using Status = Buffer::Status;
constexpr int64_t kPatience = 250'000;

TEST(MessageSynchronizer, WaitsForALivePublisherUntilItsMessage) {
  Buffer buffer(kPatience, true);
  EXPECT_EQ(buffer.status(100, 100), Status::kPending);
  buffer.put(100, "here");
  EXPECT_EQ(buffer.status(100, 100), Status::kReady);
  EXPECT_EQ(*buffer.find(100), "here");
}

TEST(MessageSynchronizer, ALaterMessageShowsThatThisOneWasLost) {
  Buffer buffer(kPatience, true);
  buffer.put(200, "later");
  EXPECT_EQ(buffer.status(100, 200), Status::kTimedOut);
  EXPECT_EQ(buffer.status(300, 300), Status::kPending)
      << "the publisher is alive: the next one is waited for";
  EXPECT_EQ(buffer.timedOut(), 1);
}

TEST(MessageSynchronizer, ADeadPublisherCostsOneWait) {
  Buffer buffer(kPatience, true);
  EXPECT_EQ(buffer.status(100, 100 + kPatience), Status::kPending);
  EXPECT_EQ(buffer.status(100, 101 + kPatience), Status::kTimedOut);
  EXPECT_EQ(buffer.status(200, 200), Status::kTimedOut) << "no second wait";
  EXPECT_EQ(buffer.timedOut(), 1);
  buffer.put(300, "back");
  EXPECT_EQ(buffer.status(400, 400), Status::kPending) << "it spoke again";
}

TEST(MessageSynchronizer, AMessageFromFarAheadDoesNotOvertakeForEver) {
  for (const int64_t stray : {int64_t{3'600'000'000}, std::numeric_limits<int64_t>::max()}) {
    Buffer buffer(kPatience, true);
    buffer.put(stray, "damaged");
    buffer.put(100, "the next");
    EXPECT_EQ(buffer.status(200, 200), Status::kPending);
  }
}

TEST(MessageSynchronizer, WhoIsNotExpectedIsNeverWaitedFor) {
  Buffer buffer(kPatience, false);
  EXPECT_EQ(buffer.status(100, 100), Status::kTimedOut);
  EXPECT_EQ(buffer.timedOut(), 0);
}

TEST(MessageSynchronizer, HoldsNoMoreThanItsCapacity) {
  Buffer buffer(kPatience, true, 4);
  for (int64_t utime = 0; utime < 100; ++utime) buffer.put(utime, "x");
  EXPECT_EQ(buffer.messages().size(), 4u);
  EXPECT_NE(buffer.find(99), nullptr);
}

}  // namespace
}  // namespace redbee
