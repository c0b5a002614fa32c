#include "redbee/node/frame_queue.hpp"

#include <gtest/gtest.h>

namespace redbee {
namespace {

constexpr Duration kPeriod(41'667);
constexpr Duration kHour = std::chrono::hours(1);
using Queue = FrameQueue<int>;

CameraTime at(int64_t k) { return CameraTime(std::chrono::hours(2) + k * kPeriod); }

/// Puts and takes frames [from, to).
void run(Queue& queue, int64_t from, int64_t to) {
  for (int64_t k = from; k < to; ++k) {
    EXPECT_EQ(queue.put(at(k), static_cast<int>(k)), FrameArrival::kQueued) << k;
    EXPECT_TRUE(queue.isInOrder(at(k))) << "no wait where the order is right, frame " << k;
    EXPECT_EQ(queue.pop(), k);
  }
}

TEST(FrameQueue, TakesFramesInOrderWithoutWaiting) {
  Queue queue;
  run(queue, 0, 30);
  EXPECT_EQ(queue.last(), at(29));
}

TEST(FrameQueue, WaitsForAnOvertakenFrameAndTakesItFirst) {
  Queue queue;
  run(queue, 0, 10);
  queue.put(at(11), 11);
  EXPECT_FALSE(queue.isInOrder(at(11)));
  queue.put(at(10), 10);
  EXPECT_TRUE(queue.isInOrder(at(11)));
  EXPECT_EQ(queue.pop(), 10);
  EXPECT_EQ(queue.pop(), 11);
}

TEST(FrameQueue, WaitsForALostFrameNoLongerThanMessagesAreReordered) {
  Queue queue;
  run(queue, 0, 10);
  queue.put(at(11), 11);
  const CameraTime last_chance = at(10) + Queue::kReordering;
  EXPECT_FALSE(queue.isInOrder(last_chance - Duration(1)));
  EXPECT_TRUE(queue.isInOrder(last_chance));
}

TEST(FrameQueue, LeavesOutWhatComesTwice) {
  Queue queue;
  run(queue, 0, 10);
  EXPECT_EQ(queue.put(at(9), 0), FrameArrival::kRepeated);
  EXPECT_EQ(queue.put(at(3), 0), FrameArrival::kRepeated);
  queue.put(at(10), 10);
  EXPECT_EQ(queue.put(at(10), 0), FrameArrival::kRepeated);
  EXPECT_EQ(queue.size(), 1U);
}

TEST(FrameQueue, OneFrameOfAnotherTimeChangesNothing) {
  for (const Duration off : {kHour, -kHour, Duration(1'900'000), Duration(-1'900'000)}) {
    Queue queue;
    run(queue, -12, 0);
    for (int64_t k = 0; k < 60; k += 3) {
      run(queue, k, k + 3);
      EXPECT_EQ(queue.put(at(k) + off, -1), FrameArrival::kHeld);
      EXPECT_TRUE(queue.empty());
    }
    EXPECT_GT(queue.takeDiscarded().of_another_time, 0);
  }
}

TEST(FrameQueue, ASecondSourceOfAnotherTimeIsNeverBelievedBesideTheFirst) {
  for (const int times_faster : {1, 10}) {
    Queue queue;
    run(queue, -12, 0);
    for (int64_t k = 0; k < 60; ++k) {
      run(queue, k, k + 1);
      for (int i = 0; i < times_faster; ++i) {
        EXPECT_EQ(queue.put(at(k) - kHour + i * kPeriod / times_faster, -1), FrameArrival::kHeld);
      }
    }
  }
}

TEST(FrameQueue, BelievesAnotherTimeAfterSomeFramesInARowAndLosesNone) {
  for (const Duration off : {kHour, -kHour, Duration(-400'000)}) {
    Queue queue;
    run(queue, 0, 20);
    for (int k = 20; k < 24; ++k) {
      EXPECT_EQ(queue.put(at(k) + off - Duration(7), k), FrameArrival::kHeld);
      EXPECT_TRUE(queue.empty());
    }
    const auto expected = off > Duration(0) ? FrameArrival::kResumed : FrameArrival::kRestarted;
    EXPECT_EQ(queue.put(at(24) + off - Duration(7), 24), expected);
    for (int k = 20; k < 25; ++k) EXPECT_EQ(queue.pop(), k);
  }
}

TEST(FrameQueue, FollowsTheSecondSourceWhenTheFirstHasGone) {
  Queue queue;
  for (int64_t k = 0; k < 20; ++k) {
    run(queue, k, k + 1);
    queue.put(at(k) - kHour, -1);
  }
  for (int64_t k = 20; k < 23; ++k) EXPECT_EQ(queue.put(at(k) - kHour, -1), FrameArrival::kHeld);
  EXPECT_EQ(queue.put(at(23) - kHour, -1), FrameArrival::kRestarted);
}

TEST(FrameQueue, ASecondCameraInBetweenIsHeldAndDiscarded) {
  for (const Duration offset : {Duration(6'000), Duration(17'000), Duration(30'000)}) {
    Queue queue;
    run(queue, 0, 20);
    for (int k = 20; k < 60; ++k) {
      EXPECT_EQ(queue.put(at(k - 1) + offset, -1), FrameArrival::kHeld);
      if (k % 20 == 5) continue;  // lost
      EXPECT_EQ(queue.put(at(k), k), FrameArrival::kQueued);
      EXPECT_EQ(queue.pop(), k);
    }
    EXPECT_GT(queue.takeDiscarded().of_another_time, 30);
  }
}

/// Frames per second of the first and of the second camera, or of the camera before and after.
TEST(FrameQueue, FollowsACameraWhoseRateChangesWithFewFramesLost) {
  for (const double factor : {0.4, 0.55, 2.0 / 3, 0.8, 0.97, 1.03, 1.25, 1.5, 2.0, 3.7}) {
    Queue queue;
    run(queue, 0, 20);
    int taken = 0;
    CameraTime time = at(19);
    for (int k = 0; k < 100; ++k) {
      time += Duration(std::llround(factor * kPeriod.count()));
      queue.put(time, k);
      while (!queue.empty() && queue.isInOrder(time)) taken += queue.pop() >= 0 ? 1 : 0;
    }
    EXPECT_GE(taken, 94) << factor;
  }
}

TEST(FrameQueue, FollowsACameraThatMultipliesItsRate) {
  for (const int factor : {2, 3, 4}) {
    Queue queue;
    run(queue, 0, 20);
    int taken = 0;
    for (int k = 1; k <= 100; ++k) {
      const CameraTime time = at(19) + k * kPeriod / factor;
      queue.put(time, k);
      while (!queue.empty() && queue.isInOrder(time)) taken += queue.pop() >= 0 ? 1 : 0;
    }
    EXPECT_GE(taken, 100 - 4 * (factor - 1)) << "held in the first four beats only, times " << factor;
  }
}

TEST(FrameQueue, AnIrregularCameraLosesNothing) {
  Queue queue;
  CameraTime time = at(0);
  int taken = 0;
  for (int k = 0; k < 200; ++k) {
    time += kPeriod + Duration(k * 7919 % 20'000) - Duration(10'000);
    EXPECT_EQ(queue.put(time, k), FrameArrival::kQueued) << k;
    for (; !queue.empty() && queue.isInOrder(time); ++taken) queue.pop();
  }
  EXPECT_GE(taken, 198);
}

TEST(FrameQueue, SkipsEvenly) {
  Queue queue;
  run(queue, 0, 10);
  for (int k = 10; k < 30; ++k) queue.put(at(k), k);
  EXPECT_EQ(queue.limitTo(10).size(), 10U);
  int last = 9;
  while (!queue.empty()) {
    const int frame = queue.pop();
    EXPECT_LE(frame - last, 2);
    last = frame;
  }
  EXPECT_EQ(last, 29) << "never the newest";
}

}  // namespace
}  // namespace redbee
