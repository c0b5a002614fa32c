#include "redbee/node/companion_buffer.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace redbee {
namespace {

using Buffer = CompanionBuffer<std::string>;
using Answer = Buffer::Answer;
constexpr int64_t kPatience = 250'000;

TEST(CompanionBuffer, WaitsForALivePublisherUntilItSpeaks) {
  Buffer buffer(kPatience, true);
  EXPECT_EQ(buffer.ask(100, 100), Answer::kWait);
  buffer.put(100, "here");
  EXPECT_EQ(buffer.ask(100, 100), Answer::kHere);
  EXPECT_EQ(*buffer.find(100), "here");
}

TEST(CompanionBuffer, ALaterMessageShowsThatThisOneWasLost) {
  Buffer buffer(kPatience, true);
  buffer.put(200, "later");
  EXPECT_EQ(buffer.ask(100, 200), Answer::kGivenUp);
  EXPECT_EQ(buffer.ask(300, 300), Answer::kWait) << "the publisher is alive: the next one is waited for";
  EXPECT_EQ(buffer.givenUp(), 1);
}

TEST(CompanionBuffer, ADeadPublisherCostsOneWait) {
  Buffer buffer(kPatience, true);
  EXPECT_EQ(buffer.ask(100, 100 + kPatience), Answer::kWait);
  EXPECT_EQ(buffer.ask(100, 101 + kPatience), Answer::kGivenUp);
  EXPECT_EQ(buffer.ask(200, 200), Answer::kGivenUp) << "no second wait";
  EXPECT_EQ(buffer.givenUp(), 1);
  buffer.put(300, "back");
  EXPECT_EQ(buffer.ask(400, 400), Answer::kWait) << "it spoke again";
}

TEST(CompanionBuffer, AMessageFromFarAheadDoesNotOvertakeForEver) {
  for (const int64_t stray : {int64_t{3'600'000'000}, std::numeric_limits<int64_t>::max()}) {
    Buffer buffer(kPatience, true);
    buffer.put(stray, "damaged");
    buffer.put(100, "the next");
    EXPECT_EQ(buffer.ask(200, 200), Answer::kWait);
  }
}

TEST(CompanionBuffer, WhoIsNotExpectedIsNeverWaitedFor) {
  Buffer buffer(kPatience, false);
  EXPECT_EQ(buffer.ask(100, 100), Answer::kGivenUp);
  EXPECT_EQ(buffer.givenUp(), 0);
}

TEST(CompanionBuffer, HoldsNoMoreThanItsCapacity) {
  Buffer buffer(kPatience, true, 4);
  for (int64_t utime = 0; utime < 100; ++utime) buffer.put(utime, "x");
  EXPECT_EQ(buffer.messages().size(), 4u);
  EXPECT_NE(buffer.find(99), nullptr);
}

}  // namespace
}  // namespace redbee
